#pragma once

#include "cuts/tree.hpp"

#include <rrcb/plan.hpp>

#include <cstddef>
#include <functional>
#include <span>

namespace rrcb {

/// Returns the owner of the cut of a node: the first rank of its first part.
inline int owner_of(const Descent& node, int num_parts, int num_ranks) {
    return ranks_of_part(node.first_part, num_parts, num_ranks).first_rank;
}

/// Parts from `first` to `end` - 1; parts_on() returns a rank's, alone or shared.
struct PartRange {
    Part first;
    Part end;
};
PartRange parts_on(int rank, int num_parts, int num_ranks);

/// Returns the parts whose first rank is `rank`, by ranks_of_part() or by an ascending list.
PartRange parts_from(int rank, int num_parts, int num_ranks);
PartRange parts_from(int rank, std::span<const RankRange> ranks_of_parts);

/// Calls visit(node, cut) for each of a rank's own cuts, in preorder. Throws Error if one is
/// missing.
void for_each_owned(const Cuts& cuts, int rank, int num_ranks,
                    const std::function<void(std::size_t node, const Cut& cut)>& visit);

}  // namespace rrcb
