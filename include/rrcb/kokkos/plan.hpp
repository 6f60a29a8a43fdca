#pragma once

#include <rrcb/kokkos/memory.hpp>
#include <rrcb/plan.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rrcb::detail {

/// Lists points by destination, each list in ascending order: a thread for each block of points
/// counts them, and later copies their indices. Places are [destination][block].
struct ListByRank {
    const Part* parts;
    const std::int32_t* slots;  ///< number of the destination of each part
    std::int64_t count;
    std::int64_t block;
    std::int64_t num_blocks;
    std::int64_t* places;
    LocalIndex* order;  ///< null: counts

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t b) const {
        const std::int64_t last = (b + 1) * block < count ? (b + 1) * block : count;
        for (std::int64_t i = b * block; i < last; ++i) {
            std::int64_t& place = places[slots[parts[i]] * num_blocks + b];
            if (order != nullptr) order[place] = static_cast<LocalIndex>(i);
            ++place;
        }
    }
};

/// Replaces counts by the sum of those before each.
struct SumBefore {
    using value_type = std::int64_t;
    std::int64_t* counts;

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t k, std::int64_t& sum, bool is_final) const {
        const std::int64_t own = counts[k];
        if (is_final) counts[k] = sum;
        sum += own;
    }
};

struct RankOfPoint {
    const Part* parts;
    const std::int32_t* ranks;
    int* result;
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i) const { result[i] = ranks[parts[i]]; }
};

/// Returns the rank that gets the points of each part from this rank.
inline std::vector<std::int32_t> ranks_of_parts(int num_parts, int rank, int num_ranks) {
    std::vector<std::int32_t> ranks;
    for (Part part = 0; part < num_parts; ++part) {
        const RankRange range = ranks_of_part(part, num_parts, num_ranks);
        ranks.push_back(range.contains(rank) ? rank : range.first_rank + rank % range.count);
    }
    return ranks;
}

/// Returns the indices of points by ascending slot of their part; sets the number in each slot.
/// Two fences.
template <class Memory, class Execution>
auto list_by_rank(const Execution& exec, const Part* parts, std::int64_t count,
                  std::span<const std::int32_t> slots, std::vector<std::int64_t>& numbers) {
    const auto num_slots = static_cast<std::int64_t>(numbers.size());
    // So that the places need less memory than the points.
    const std::int64_t block = std::max<std::int64_t>(4096, num_slots);
    const std::int64_t num_blocks = (count + block - 1) / block;
    const std::int64_t size = num_slots * num_blocks;
    const auto table = copy_in<Memory>(exec, slots);
    const auto places = allocate<std::int64_t, Memory>(exec, static_cast<std::size_t>(size), true);
    const auto order = allocate<LocalIndex, Memory>(exec, static_cast<std::size_t>(count));
    ListByRank list{parts, table.data(), count, block, num_blocks, places.data(), nullptr};
    Kokkos::parallel_for("rrcb::count_by_rank", range(exec, num_blocks), list);
    Kokkos::parallel_scan("rrcb::sum_before", range(exec, size), SumBefore{places.data()});
    list.order = order.data();
    Kokkos::parallel_for("rrcb::list_by_rank", range(exec, num_blocks), list);
    // Each place is now the end of its list.
    std::vector<std::int64_t> ends(static_cast<std::size_t>(size));
    copy_out(exec, places, std::span(ends));
    exec.fence();
    std::int64_t before = 0;
    for (std::int64_t slot = 0; slot < num_slots && num_blocks > 0; ++slot) {
        const std::int64_t end = ends[static_cast<std::size_t>((slot + 1) * num_blocks - 1)];
        numbers[static_cast<std::size_t>(slot)] = end - std::exchange(before, end);
    }
    return order;
}

}  // namespace rrcb::detail
