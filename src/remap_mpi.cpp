#include "assignment.hpp"
#include "mpi/communicator.hpp"

#include <rrcb/remap.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace rrcb {

namespace {

constexpr int root = 0;
constexpr std::size_t overlaps_per_part = 16;

/// How many points of one origin, a rank or an earlier part, go to a part.
struct Overlap {
    std::int32_t origin = 0;
    Part part = 0;
    GlobalCount count = 0;
};

/// Where points stay.
struct Homes {
    std::span<const RankRange> ranks_of_parts;
    bool by_rank = true;  ///< origins are ranks, not earlier parts

    int num_parts() const { return static_cast<int>(ranks_of_parts.size()); }

    /// Points of `origin` stay in parts of the numbers first ... last - 1.
    struct Numbers {
        Part first;
        Part last;
    };
    Numbers numbers_for(std::int32_t origin) const {
        if (!by_rank && origin < num_parts()) return {origin, origin + 1};
        if (!by_rank) return {0, 0};
        const auto found = std::ranges::equal_range(ranks_of_parts, origin, {}, &RankRange::first);
        return {static_cast<Part>(found.begin() - ranks_of_parts.begin()),
                static_cast<Part>(found.end() - ranks_of_parts.begin())};
    }
};

/// Overlaps by count, the largest first, at most `limit` of them.
void keep_largest(std::size_t limit, std::vector<Overlap>& overlaps) {
    std::ranges::sort(overlaps, [](const Overlap& a, const Overlap& b) {
        return std::tie(b.count, a.origin, a.part) < std::tie(a.count, b.origin, b.part);
    });
    if (overlaps.size() > limit) overlaps.resize(limit);
}

std::vector<Overlap> overlaps_by_rank(std::span<const Part> parts, int num_parts, int my_rank) {
    std::vector<GlobalCount> counts(static_cast<std::size_t>(num_parts), 0);
    for (const Part part : parts) ++counts[static_cast<std::size_t>(part)];
    std::vector<Overlap> overlaps;
    for (Part part = 0; part < num_parts; ++part) {
        const GlobalCount count = counts[static_cast<std::size_t>(part)];
        if (count > 0) overlaps.push_back({my_rank, part, count});
    }
    return overlaps;
}

std::vector<Overlap> overlaps_by_part(std::span<const Part> parts, std::span<const Part> previous,
                                      int num_parts) {
    std::vector<std::pair<Part, Part>> pairs;
    pairs.reserve(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        // Earlier numbers that are no longer in use cannot be kept.
        if (previous[i] >= 0 && previous[i] < num_parts) pairs.emplace_back(previous[i], parts[i]);
    }
    std::ranges::sort(pairs);
    std::vector<Overlap> overlaps;
    for (const auto& [origin, part] : pairs) {
        const bool same =
            !overlaps.empty() && overlaps.back().origin == origin && overlaps.back().part == part;
        if (!same) overlaps.push_back({origin, part, 0});
        ++overlaps.back().count;
    }
    return overlaps;
}

/// A fixed number of overlaps from each rank, so that one gather carries all. Unused entries count
/// 0; the first holds the number of points. Collective over `comm`.
std::vector<Overlap> gather(std::vector<Overlap> mine, std::size_t num_points, int num_parts,
                            MPI_Comm comm) {
    const int num_ranks = mpi::size_of(comm);
    const std::size_t parts_per_rank = static_cast<std::size_t>((num_parts - 1) / num_ranks + 1);
    const std::size_t limit = overlaps_per_part * parts_per_rank;
    keep_largest(limit, mine);
    mine.resize(limit);
    mine.insert(mine.begin(), {0, 0, static_cast<GlobalCount>(num_points)});
    const bool is_root = mpi::rank_of(comm) == root;
    std::vector<Overlap> all(is_root ? mine.size() * static_cast<std::size_t>(num_ranks) : 0);
    const int bytes = mpi::to_int(static_cast<std::int64_t>(mine.size() * sizeof(Overlap)));
    mpi::check(MPI_Gather(mine.data(), bytes, MPI_BYTE, all.data(), bytes, MPI_BYTE, root, comm),
               "MPI_Gather");
    return all;
}

/// Takes the number of points out of what was gathered.
GlobalCount extract_num_points(std::vector<Overlap>& gathered, int num_ranks) {
    const std::size_t stride = gathered.size() / static_cast<std::size_t>(num_ranks);
    GlobalCount num_points = 0;
    for (std::size_t i = 0; i < gathered.size(); i += stride) {
        num_points += std::exchange(gathered[i].count, 0);
    }
    std::erase_if(gathered, [](const Overlap& overlap) { return overlap.count == 0; });
    return num_points;
}

std::vector<Gain> gains_of(std::span<const Overlap> overlaps, const Homes& homes) {
    std::vector<Gain> gains;
    for (const Overlap& overlap : overlaps) {
        const auto [first, last] = homes.numbers_for(overlap.origin);
        for (Part number = first; number < last; ++number) {
            gains.push_back({overlap.part, number, overlap.count});
        }
    }
    return gains;
}

GlobalCount kept(std::span<const Overlap> overlaps, std::span<const Part> numbers,
                 const Homes& homes) {
    GlobalCount sum = 0;
    for (const Overlap& overlap : overlaps) {
        const auto [first, last] = homes.numbers_for(overlap.origin);
        const Part number = numbers[static_cast<std::size_t>(overlap.part)];
        if (number >= first && number < last) sum += overlap.count;
    }
    return sum;
}

/// The root's decision.
Remap decide(std::vector<Overlap> gathered, int num_ranks, const Homes& homes) {
    Remap remap;
    remap.num_points = extract_num_points(gathered, num_ranks);
    std::vector<Part> unchanged(static_cast<std::size_t>(homes.num_parts()));
    std::iota(unchanged.begin(), unchanged.end(), 0);
    remap.numbers = best_numbers(gains_of(gathered, homes), homes.num_parts());
    remap.kept_before = kept(gathered, unchanged, homes);
    remap.kept_after = kept(gathered, remap.numbers, homes);
    if (remap.kept_after > remap.kept_before) return remap;
    remap.numbers = std::move(unchanged);
    remap.kept_after = remap.kept_before;
    return remap;
}

/// Collective over `comm`: one broadcast.
void share(Remap& remap, MPI_Comm comm) {
    std::vector<GlobalCount> message(remap.numbers.begin(), remap.numbers.end());
    message.insert(message.end(), {remap.num_points, remap.kept_before, remap.kept_after});
    mpi::check(MPI_Bcast(message.data(), mpi::to_int(static_cast<std::int64_t>(message.size())),
                         MPI_INT64_T, root, comm),
               "MPI_Bcast");
    const std::size_t num_parts = remap.numbers.size();
    for (std::size_t p = 0; p < num_parts; ++p) remap.numbers[p] = static_cast<Part>(message[p]);
    remap.num_points = message[num_parts];
    remap.kept_before = message[num_parts + 1];
    remap.kept_after = message[num_parts + 2];
    remap.identity = remap.kept_after == remap.kept_before;
}

/// Collective over `comm`.
Remap remap(std::vector<Overlap> overlaps, std::size_t num_points, const Homes& homes,
            MPI_Comm comm) {
    const int num_parts = homes.num_parts();
    std::vector<Overlap> gathered = gather(std::move(overlaps), num_points, num_parts, comm);
    Remap result;
    result.numbers.resize(static_cast<std::size_t>(num_parts));
    if (mpi::rank_of(comm) == root) {
        result = decide(std::move(gathered), mpi::size_of(comm), homes);
    }
    share(result, comm);
    return result;
}

}  // namespace

Remap remap(std::span<const Part> parts, std::span<const RankRange> ranks_of_parts, MPI_Comm user) {
    const MPI_Comm comm = mpi::duplicate_of(user);
    const Homes homes{ranks_of_parts, true};
    return remap(overlaps_by_rank(parts, homes.num_parts(), mpi::rank_of(comm)), parts.size(),
                 homes, comm);
}

Remap remap(std::span<const Part> parts, std::span<const Part> previous,
            std::span<const RankRange> ranks_of_parts, MPI_Comm user) {
    const Homes homes{ranks_of_parts, false};
    return remap(overlaps_by_part(parts, previous, homes.num_parts()), parts.size(), homes,
                 mpi::duplicate_of(user));
}

}  // namespace rrcb
