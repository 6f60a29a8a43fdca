#pragma once

#include "cuts/tree.hpp"

#include <rrcb/plan.hpp>

#include <span>

namespace rrcb {

/// Returns the owner of the cut of a node: the first rank of its first part.
inline int owner_of(const Descent& node, int num_parts, int num_ranks) {
    return ranks_of_part(node.first_part, num_parts, num_ranks).first_rank;
}

/// Parts from `first` to `end` - 1.
struct PartRange {
    Part first;
    Part end;
};
PartRange parts_on(int rank, int num_parts, int num_ranks);

/// Return the parts whose first rank is `rank`, according to ranks_of_part() or to an ascending
/// list.
PartRange parts_from(int rank, int num_parts, int num_ranks);
PartRange parts_from(int rank, std::span<const RankRange> ranks_of_parts);

}  // namespace rrcb
