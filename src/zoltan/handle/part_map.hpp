#pragma once

#include <rrcb/plan.hpp>
#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb::zoltan {

/// The ranks of each part, as Zoltan lays parts out.
struct PartMap {
    std::vector<RankRange> ranks;  ///< of each part
    bool one_each = true;          ///< part p is on rank p and on no other

    int num_parts() const { return static_cast<int>(ranks.size()); }

    /// Where object number `index` of rank `rank` goes: it stays when its part is there already.
    int destination(Part part, LocalIndex index, int rank) const {
        const RankRange& range = ranks[static_cast<std::size_t>(part)];
        if (range.count == 1) return range.first_rank;
        if (rank >= range.first_rank && rank < range.first_rank + range.count) return rank;
        return range.first_rank + static_cast<int>(index % static_cast<LocalIndex>(range.count));
    }
};

/// Equal numbers of parts on all ranks, or of ranks for all parts.
PartMap even_part_map(int num_parts, int num_ranks);

/// The number of parts that NUM_LOCAL_PARTS and NUM_GLOBAL_PARTS ask for. `local_parts` holds one
/// number per rank, -1 where it is not set; so is `num_global_parts`. Throws ZoltanError when they
/// do not add up.
int num_parts_of(std::span<const int> local_parts, int num_global_parts);

/// As many parts on a rank as its NUM_LOCAL_PARTS; ranks where it is not set share the rest.
PartMap local_part_map(std::span<const int> local_parts, int num_parts);

/// The lowest part on a rank, -1 where there is none.
int first_part_of(const PartMap& map, int rank);

}  // namespace rrcb::zoltan
