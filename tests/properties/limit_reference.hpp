#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <string>

// What limited cuts are held against: definitions taken literally, and all there is tried.
namespace rrcb::test {

/// What is wrong with where the cuts lie, or nothing; `box` is that of the points. Parts of size 0
/// are passed over.
std::string fault_of_limits(const Cuts& cuts, const Options& options, const Box& box);

/// The imbalance of the best bisection into equal parts within the limits of the options, by
/// trying every axis and place of every cut that may matter; infinity where there is none. For a
/// few points and parts.
double least_imbalance(const Points& points, const Options& options);

}  // namespace rrcb::test
