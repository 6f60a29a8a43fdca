#include "lists/remap_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "lists/hungarian.hpp"
#include "lists/rank_numbers.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace rrcb {

namespace {

/// Rule for where points stay.
struct Owners {
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
        // Not equal_range, whose answer clang 14 cannot read with GCC's library.
        const auto first =
            std::ranges::lower_bound(ranks_of_parts, origin, {}, &RankRange::first_rank);
        const auto last =
            std::ranges::upper_bound(ranks_of_parts, origin, {}, &RankRange::first_rank);
        return {static_cast<Part>(first - ranks_of_parts.begin()),
                static_cast<Part>(last - ranks_of_parts.begin())};
    }
};

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

/// Gathers a fixed number of overlaps from each rank, so that one gather carries all. Collective.
///
/// Unused entries count 0. The first holds the number of points, and 1 as its part where the rank
/// has failed.
void gather_overlaps(std::vector<Overlap> mine, std::size_t num_points, RemapBuffers& buffers,
                     const Participant& self) {
    keep_largest(buffers.mine.size() - 1, mine);
    std::ranges::fill(buffers.mine, Overlap{});
    buffers.mine[0] = {0, self.failed() ? 1 : 0, static_cast<GlobalCount>(num_points)};
    std::ranges::copy(mine, buffers.mine.begin() + 1);
    const int bytes = static_cast<int>(buffers.mine.size() * sizeof(Overlap));
    mpi::check(MPI_Gather(buffers.mine.data(), bytes, MPI_BYTE, buffers.all.data(), bytes, MPI_BYTE,
                          root, self.comm),
               "MPI_Gather");
}

/// Sums all overlaps with earlier parts over the ranks, and behind them the points and the ranks
/// that have failed. Collective: one reduction.
void sum_up(std::span<const Part> parts, std::span<const Part> previous, RemapBuffers& buffers,
            const Participant& self) {
    const std::size_t num_parts = buffers.numbers.size();
    std::ranges::fill(buffers.sums, 0);
    for (std::size_t i = 0; i < parts.size() && !self.failed(); ++i) {
        const auto origin = static_cast<std::size_t>(previous[i]);
        if (previous[i] >= 0 && origin < num_parts)
            ++buffers.sums[origin * num_parts + static_cast<std::size_t>(parts[i])];
    }
    const std::span tail = std::span(buffers.sums).last<2>();
    tail[0] = static_cast<GlobalCount>(parts.size());
    tail[1] = self.failed() ? 1 : 0;
    const bool is_root = mpi::rank_of(self.comm) == root;
    mpi::check(
        MPI_Reduce(is_root ? MPI_IN_PLACE : buffers.sums.data(), buffers.sums.data(),
                   static_cast<int>(buffers.sums.size()), MPI_INT64_T, MPI_SUM, root, self.comm),
        "MPI_Reduce");
}

std::vector<Overlap> overlaps_of(const RemapBuffers& buffers) {
    const std::size_t num_parts = buffers.numbers.size();
    std::vector<Overlap> overlaps;
    for (std::size_t k = 0; k < num_parts * num_parts; ++k)
        if (buffers.sums[k] > 0)
            overlaps.push_back({static_cast<Part>(k / num_parts), static_cast<Part>(k % num_parts),
                                buffers.sums[k]});
    return overlaps;
}

/// Lowest rank that failed, as far as the message to the root tells.
int lowest_failing_rank(const RemapBuffers& buffers) {
    if (buffers.holds_sums()) return buffers.sums.back() > 0 ? some_rank : no_rank;
    for (std::size_t i = 0; i < buffers.all.size(); i += buffers.mine.size())
        if (buffers.all[i].part != 0) return static_cast<int>(i / buffers.mine.size());
    return no_rank;
}

/// Takes the number of points out of the message to the root.
GlobalCount extract_num_points(RemapBuffers& buffers) {
    if (buffers.holds_sums()) return buffers.sums.end()[-2];
    GlobalCount num_points = 0;
    for (std::size_t i = 0; i < buffers.all.size(); i += buffers.mine.size())
        num_points += std::exchange(buffers.all[i].count, 0);
    return num_points;
}

std::vector<Gain> gains_of(std::span<const Overlap> overlaps, const Owners& owners) {
    std::vector<Gain> gains;
    for (const Overlap& overlap : overlaps) {
        if (overlap.count == 0) continue;
        const auto [first, last] = owners.numbers_for(overlap.origin);
        for (Part number = first; number < last; ++number) {
            gains.push_back({overlap.part, number, overlap.count});
        }
    }
    return gains;
}

/// Numbers that keep many points. A rank of many parts has too many gains to list: for each overlap
/// as many as it has parts.
std::vector<Part> good_numbers(std::span<const Overlap> overlaps, const Owners& owners) {
    if (owners.by_rank && owners.num_parts() > most_parts_exact)
        return numbers_by_rank(overlaps, owners.ranks_of_parts);
    return best_numbers(gains_of(overlaps, owners), owners.num_parts());
}

GlobalCount kept(std::span<const Overlap> overlaps, std::span<const Part> numbers,
                 const Owners& owners) {
    GlobalCount sum = 0;
    for (const Overlap& overlap : overlaps) {
        if (overlap.count == 0) continue;
        const auto [first, last] = owners.numbers_for(overlap.origin);
        const Part number = numbers[static_cast<std::size_t>(overlap.part)];
        if (number >= first && number < last) sum += overlap.count;
    }
    return sum;
}

/// Decision of the root.
Remap decide_numbers(RemapBuffers& buffers, const Owners& owners) {
    Remap remap;
    remap.num_points = extract_num_points(buffers);
    const std::vector<Overlap> sums =
        buffers.holds_sums() ? overlaps_of(buffers) : std::vector<Overlap>();
    const std::span<const Overlap> overlaps = buffers.holds_sums() ? sums : buffers.all;
    std::vector<Part> unchanged(static_cast<std::size_t>(owners.num_parts()));
    std::iota(unchanged.begin(), unchanged.end(), 0);
    remap.numbers = good_numbers(overlaps, owners);
    remap.kept_before = kept(overlaps, unchanged, owners);
    remap.kept_after = kept(overlaps, remap.numbers, owners);
    if (remap.kept_after > remap.kept_before) return remap;
    remap.numbers = std::move(unchanged);
    remap.kept_after = remap.kept_before;
    return remap;
}

/// Shares the decision of the root, or the failing rank; returns the latter. Collective over
/// `comm`: one broadcast.
int share(int failing_rank, Remap& remap, RemapBuffers& buffers, MPI_Comm comm) {
    const std::size_t num_parts = buffers.numbers.size();
    std::ranges::copy(remap.numbers, buffers.decision.begin());
    const std::span tail = std::span(buffers.decision).last<4>();
    tail[0] = failing_rank;
    tail[1] = remap.num_points;
    tail[2] = remap.kept_before;
    tail[3] = remap.kept_after;
    mpi::broadcast(std::as_writable_bytes(std::span(buffers.decision)), root, comm);
    for (std::size_t p = 0; p < num_parts; ++p)
        buffers.numbers[p] = static_cast<Part>(buffers.decision[p]);
    remap.numbers = std::move(buffers.numbers);
    remap.num_points = tail[1];
    remap.kept_before = tail[2];
    remap.kept_after = tail[3];
    remap.identity = remap.kept_after == remap.kept_before;
    return static_cast<int>(tail[0]);
}

}  // namespace

void keep_largest(std::size_t limit, std::vector<Overlap>& overlaps) {
    std::ranges::sort(overlaps, [](const Overlap& a, const Overlap& b) {
        return std::tie(b.count, a.origin, a.part) < std::tie(a.count, b.origin, b.part);
    });
    if (overlaps.size() > limit) overlaps.resize(limit);
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

std::uint64_t hash_of(std::span<const RankRange> ranks_of_parts) {
    std::uint64_t hash = ranks_of_parts.size();
    for (const RankRange& ranks : ranks_of_parts) {
        for (const int number : {ranks.first_rank, ranks.count})
            hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

RemapBuffers::RemapBuffers(int num_parts, int num_ranks, bool is_root, Origins origins) {
    const auto parts_per_rank = static_cast<std::size_t>((num_parts - 1) / num_ranks + 1);
    numbers.resize(static_cast<std::size_t>(num_parts));
    decision.resize(numbers.size() + 4);
    if (origins == Origins::parts && num_parts <= most_parts_exact) {
        sums.resize(numbers.size() * numbers.size() + 2);
        return;
    }
    mine.resize(1 + overlaps_per_part * parts_per_rank);
    mpi::to_int(static_cast<std::int64_t>(mine.size() * sizeof(Overlap)));
    if (is_root) all.resize(mine.size() * static_cast<std::size_t>(num_ranks));
}

Remap remap(std::span<const Part> parts, const PreviousParts& previous,
            std::span<const RankRange> ranks_of_parts, RemapBuffers& buffers, Participant& self) {
    const Owners owners{ranks_of_parts, !previous};
    const int rank = mpi::rank_of(self.comm);
    if (buffers.holds_sums()) {
        sum_up(parts, *previous, buffers, self);
    } else {
        std::vector<Overlap> overlaps;
        self.attempt([&] {
            overlaps = previous ? overlaps_by_part(parts, *previous, owners.num_parts())
                                : overlaps_by_rank(parts, owners.num_parts(), rank);
        });
        gather_overlaps(std::move(overlaps), parts.size(), buffers, self);
    }
    Remap result;
    if (rank == root) {
        self.hear_of(lowest_failing_rank(buffers));
        self.attempt([&] { result = decide_numbers(buffers, owners); });
    }
    fail_together(share(self.failing_rank(), result, buffers, self.comm), self);
    return result;
}

}  // namespace rrcb
