#pragma once

#include "collective/participant.hpp"

#include <rrcb/remap.hpp>

#include <optional>
#include <span>
#include <vector>

namespace rrcb {

/// Number of points of one origin, a rank or an earlier part, that go to a part.
struct Overlap {
    std::int32_t origin = 0;
    Part part = 0;
    GlobalCount count = 0;
};

/// Overlaps that a rank tells for each of its parts at most.
inline constexpr std::size_t overlaps_per_part = 16;

/// Sorts overlaps by count, the largest first; leaves `limit` of them at most.
void keep_largest(std::size_t limit, std::vector<Overlap>& overlaps);

/// Points by earlier part and part, where both are below `num_parts`.
std::vector<Overlap> overlaps_by_part(std::span<const Part> parts, std::span<const Part> previous,
                                      int num_parts);

/// Kind of the origins of overlaps.
enum class Origins {
    ranks,  ///< the root gets the heaviest overlaps of each rank
    parts   ///< earlier ones; the root gets all overlaps, as sums, up to `most_parts_exact` parts
};

/// Buffers for the messages of a renumbering. The ranks make them and agree before the first
/// message: a rank that runs out of memory later can still take part until all have been told.
struct RemapBuffers {
    /// Not collective. Throws Error or std::bad_alloc.
    RemapBuffers(int num_parts, int num_ranks, bool is_root, Origins origins = Origins::ranks);

    bool holds_sums() const { return !sums.empty(); }

    std::vector<Overlap> mine;          ///< of this rank, for the root; of fixed length
    std::vector<Overlap> all;           ///< of all ranks, at the root
    std::vector<GlobalCount> sums;      ///< of points by origin and part; then points, failed ranks
    std::vector<GlobalCount> decision;  ///< of the root, on its way
    std::vector<Part> numbers;          ///< one per part
};

/// Hash of lists that must be the same on every rank.
std::uint64_t hash_of(std::span<const RankRange> ranks_of_parts);

/// Earlier parts of the points; none when points are to stay on their rank.
using PreviousParts = std::optional<std::span<const Part>>;

/// Renumbers as the public functions do, from checked arguments and with the caller's buffers.
///
/// Collective: one gather, or one reduction where the buffers hold sums, then one broadcast. The
/// buffers decide which: unless they hold sums, `previous` may be there on some ranks only. A
/// failure from before the call is thrown on all ranks as well.
Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, RemapBuffers& buffers, Participant& self);

}  // namespace rrcb
