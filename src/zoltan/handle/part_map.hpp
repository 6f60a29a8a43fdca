#pragma once

#include "cuts/owned_cuts.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb::zoltan {

/// The ranks of each part, according to Zoltan's rules.
struct PartMap {
    int num_parts = 0;
    int num_ranks = 0;
    bool one_each = true;             ///< whether part p is on rank p only, for every p
    bool is_even = true;              ///< whether the ranks are those of ranks_of_part()
    std::vector<RankRange> listed{};  ///< ranks of each part; empty if is_even and there are many
                                      ///< parts

    bool has_one_rank_per_part() const { return !is_even || num_parts >= num_ranks; }

    RankRange ranks_of(Part part) const {
        if (one_each) return {part, 1};
        return listed.empty() ? ranks_of_part(part, num_parts, num_ranks) : listed[part];
    }

    /// Returns the parts on a rank.
    PartRange parts_on(int rank) const;

    /// Returns the rank to which object number `index` of rank `rank` goes. The object remains on
    /// its rank if that holds the part.
    int destination(Part part, LocalIndex index, int rank) const {
        const RankRange range = ranks_of(part);
        if (range.count == 1) return range.first_rank;
        if (range.contains(rank)) return rank;
        return range.first_rank + static_cast<int>(index % static_cast<LocalIndex>(range.count));
    }
};

/// Returns a map that gives all ranks equal numbers of parts, or all parts equal numbers of ranks.
PartMap even_part_map(int num_parts, int num_ranks);

/// Returns the number of parts that NUM_LOCAL_PARTS and NUM_GLOBAL_PARTS ask for. `local_parts` has
/// one number for each rank. Its numbers and `num_global_parts` are -1 where they are not set.
/// Throws ZoltanError if they do not add up.
int num_parts_of(std::span<const int> local_parts, int num_global_parts);

/// Returns a map that gives each rank as many parts as its NUM_LOCAL_PARTS. Ranks that do not set
/// it share the remaining parts.
PartMap local_part_map(std::span<const int> local_parts, int num_parts);

/// Returns the lowest part on a rank; -1 if the rank has no part.
int first_part_of(const PartMap& map, int rank);

}  // namespace rrcb::zoltan
