#pragma once

#include "cuts/cut_limits.hpp"

#include <rrcb/detail/bisection.hpp>
#include <rrcb/detail/statistical_domain.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Returns the weight of each cell, or its count if no cell has weight.
std::vector<double> weights_of(std::span<const CellMoments> cells);

double weight_of(const StatisticalDomain& domain);

/// A domain on both sides of a cut.
struct Halves {
    StatisticalDomain lower;
    StatisticalDomain upper;
};

Halves split_domain(StatisticalDomain domain, const Cut& cut);

}  // namespace rrcb
