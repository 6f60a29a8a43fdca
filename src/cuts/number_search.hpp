#pragma once

#include "cuts/owned_cuts.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/tree_shape.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb {

inline constexpr std::int32_t no_origin = -1;

/// Number of points in a part that come from one origin: a rank or an earlier part. The origin is
/// no_origin if no number can keep the points there.
struct Overlap {
    std::int32_t origin = no_origin;
    Part part = 0;
    GlobalCount count = 0;
};

/// Determines which number of a part keeps the points of which origin.
struct NumberRule {
    int num_parts = 1;
    int num_ranks = 1;
    bool by_rank = true;  ///< whether origins are ranks; otherwise they are earlier parts
    /// Ranks of each part, ascending; only the first rank of a part counts. If empty, they are
    /// those of ranks_of_part().
    std::span<const RankRange> listed{};
    TreeShape shape{};  ///< shape of the tree; a part can only get numbers of its own group

    /// Returns the origin whose points a part with this number keeps. numbers_of() is the inverse.
    std::int32_t home_of(Part number) const;
    PartRange numbers_of(std::int32_t origin) const;

    /// Returns whether the numbers that keep the points of an origin are in the group of a part.
    bool is_in_group(Part part, std::int32_t origin) const {
        return shape.group_size == 1 || origin == no_origin ||
               group_of(origin) == group_of_part(part);
    }
    /// Returns the group of the numbers that keep the points of an origin; -1 if they are in
    /// several groups.
    int group_of(std::int32_t origin) const;
    int group_of_part(Part part) const { return shape.end_of(part, num_parts) / shape.group_size; }

    /// Returns the rule for groups instead of parts. The origin of a group is its earlier number.
    NumberRule of_groups() const;
    /// Returns the number of a part if its group gets the number in `numbers_of_groups`.
    Part with_group(Part part, std::span<const Part> numbers_of_groups) const;
};

/// Returns the number of each part, found by the greedy method: the largest overlap gives its part
/// a number of its origin, then the next largest one for which that is possible, and so on.
///
/// This keeps at least half as many points as possible. Of equal overlaps, that of a part with its
/// present number comes first, then the lowest part, then the lowest origin. A part keeps its
/// number if that is one of its origin's numbers; the other parts of an origin get the remaining
/// ones in ascending order. Parts that are left over get the unused numbers of their group in the
/// same way. `overlaps` has at most one entry for each part and origin. Throws std::bad_alloc.
std::vector<Part> greedy_numbers(const NumberRule& rule, std::span<const Overlap> overlaps);

}  // namespace rrcb
