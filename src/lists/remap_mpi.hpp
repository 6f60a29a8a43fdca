#pragma once

#include "collective/participant.hpp"

#include <rrcb/remap.hpp>

#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// How many points of one origin, a rank or an earlier part, go to a part.
struct Overlap {
    std::int32_t origin = 0;
    Part part = 0;
    GlobalCount count = 0;
};

/// What the points of an overlap have in common.
enum class Origins {
    ranks,  ///< the heaviest overlaps of each rank reach the root
    parts   ///< earlier ones: all overlaps do, as sums, up to `most_parts_exact` parts
};

/// What the messages of a renumbering need. Made, and agreed on, before the first of them: a rank
/// that runs out of memory later can still take part until all have been told.
struct RemapBuffers {
    /// Not collective. Throws Error or std::bad_alloc.
    RemapBuffers(int num_parts, int num_ranks, bool is_root, Origins origins = Origins::ranks);

    bool holds_sums() const { return !sums.empty(); }

    std::vector<Overlap> mine;          ///< what the root is told; of fixed length
    std::vector<Overlap> all;           ///< of all ranks, at the root
    std::vector<GlobalCount> sums;      ///< of points by origin and part; then what else is told
    std::vector<GlobalCount> decision;  ///< of the root, on its way
    std::vector<Part> numbers;          ///< one per part
};

/// Parts that the points were in; none when points are to stay on their rank.
using PreviousParts = std::optional<std::span<const Part>>;

/// As the public functions, without a look at the arguments. Collective: one gather, or one
/// reduction where the room holds sums, and one broadcast. The room decides which: `previous` may
/// be there on some ranks only, unless it holds sums. What went wrong on a rank before is told to
/// all as well.
Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, RemapBuffers& buffers, Participant& self);

}  // namespace rrcb
