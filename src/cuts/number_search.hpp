#pragma once

#include "cuts/owned_cuts.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/tree_shape.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

inline constexpr std::int32_t no_origin = -1;

/// Number of points from one origin, a rank or an earlier part, in a part. Points without a number
/// to keep them have no_origin.
struct Overlap {
    std::int32_t origin = no_origin;
    Part part = 0;
    GlobalCount count = 0;
};

/// Origins whose points are kept.
struct NumberRule {
    int num_parts = 1;
    int num_ranks = 1;
    bool by_rank = true;  ///< origins are ranks; else earlier parts
    /// Ranks of the parts, ascending; the first one of a part counts. Empty: as ranks_of_part().
    std::span<const RankRange> listed{};
    TreeShape shape{};  ///< of the tree; parts get the numbers of parts of their group

    /// Returns the origin whose points a part of this number keeps; numbers_of() is the inverse.
    std::int32_t home_of(Part number) const;
    PartRange numbers_of(std::int32_t origin) const;

    /// Returns whether the numbers for keeping the points of an origin are of the group of a part.
    bool is_in_group(Part part, std::int32_t origin) const {
        return shape.group_size == 1 || origin == no_origin ||
               group_of(origin) == group_of_part(part);
    }
    /// Returns the group of the numbers for keeping the points of an origin; -1 if there are
    /// several.
    int group_of(std::int32_t origin) const;
    int group_of_part(Part part) const { return shape.end_of(part, num_parts) / shape.group_size; }

    /// Returns the rule for groups in place of parts; their origins are their earlier numbers.
    NumberRule of_groups() const;
    /// Returns the number of a part if its group gets that of `numbers_of_groups`.
    Part with_group(Part part, std::span<const Part> numbers_of_groups) const;
};

/// Returns the number of each part by the greedy method: the largest overlap of all gives its part
/// a number of its origin, then the next largest one that is possible.
///
/// This keeps at least half of the most points. Of equal overlaps that of a part with its present
/// number comes first, then the lowest part, then the lowest origin. The parts of an origin keep
/// their number if it is one of the origin's, and get the others in ascending order; parts left
/// over get the unused numbers of their group likewise. `overlaps` are one of each part and origin.
/// Throws std::bad_alloc.
std::vector<Part> greedy_numbers(const NumberRule& rule, std::span<const Overlap> overlaps);

}  // namespace rrcb
