#pragma once

#include "cuts/tree.hpp"

#include <rrcb/plan.hpp>

#include <span>

namespace rrcb {

/// Rank that knows the cut of a node on behalf of all: the first one of its first part.
inline int owner_of(const Descent& node, int num_parts, int num_ranks) {
    return ranks_of_part(node.first_part, num_parts, num_ranks).first_rank;
}

/// Writes the cuts that a rank owns to their places in the whole tree. Throws Error where it lacks
/// one.
void write_owned(const Cuts& cuts, int rank, int num_ranks, std::span<Cut> tree);

}  // namespace rrcb
