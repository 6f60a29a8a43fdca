#pragma once

#include "../support/common.hpp"
#include "share.hpp"

#include <rrcb/cuts.hpp>

namespace rrcb::hard_test {

/// Part of every point of the cloud, on all ranks; fails unless each was given one part by one
/// rank. Collective.
std::vector<Part> join_parts(const Share& share, std::span<const Part> parts, int count,
                             int num_parts);

/// What this rank holds once every point is where its part is.
Share migrated(const Cloud& cloud, std::span<const Part> parts, int num_parts);

/// How many points get another part than before. Collective.
int count_moves(const Share& share, std::span<const Part> parts, std::span<const Part> before);

/// Axis and position of every cut.
std::vector<double> numbers_of(const Cuts& cuts);

/// The bytes of `values` must be the same on every rank. Collective.
void expect_same_on_all_ranks(std::span<const std::byte> values);

/// The numbers of both sides must be the same over all ranks, in any order. Collective.
void expect_same_in_all(std::span<const std::uint64_t> one, std::span<const std::uint64_t> other);

/// A number that stands for a point on its way from a rank to a part on another.
std::uint64_t journey(std::uint64_t point, int from, int to, Part part);

/// No part is heavier than `tolerance` times its share by more than the heaviest place, so that it
/// is within the tolerance wherever that is possible. Sums are in long double. Not collective.
void expect_balanced(const Cloud& cloud, std::span<const Part> parts, int num_parts,
                     double tolerance);

/// Heaviest part over mean part, in long double; by number where all weights are 0.
double imbalance_of(const Cloud& cloud, std::span<const Part> parts, int num_parts);

}  // namespace rrcb::hard_test
