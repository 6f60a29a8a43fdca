#pragma once

#include <rrcb/kokkos/device.hpp>
#include <rrcb/plan.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::detail {

/// Returns the rank that gets the points of each part from this rank.
inline std::vector<int> ranks_of_parts(int num_parts, int rank, int num_ranks) {
    std::vector<int> ranks;
    for (Part part = 0; part < num_parts; ++part) {
        const RankRange range = ranks_of_part(part, num_parts, num_ranks);
        ranks.push_back(range.contains(rank) ? rank : range.first_rank + rank % range.count);
    }
    return ranks;
}

/// Lists points by rank, each list in ascending order: a thread for each block of points counts
/// them, and later lists them. Places are [rank][block].
struct ListBlock {
    const int* ranks;
    std::int64_t count;
    std::int64_t length;
    std::int64_t num_blocks;
    std::int64_t* places;
    LocalIndex* order;  ///< null: counts

    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t block) const {
        const std::int64_t end = (block + 1) * length < count ? (block + 1) * length : count;
        for (std::int64_t i = block * length; i < end; ++i) {
            const std::int64_t place = places[ranks[i] * num_blocks + block]++;
            if (order != nullptr) order[place] = static_cast<LocalIndex>(i);
        }
    }
};

/// Fills `order` with the points by rank, each list in ascending order; returns the end of the list
/// of each rank. A fence.
template <class Device, class Ranks, class Order>
std::vector<std::int64_t> list_by_rank(Device& device, int num_ranks, const Ranks& ranks,
                                       const Order& order) {
    const auto count = static_cast<std::int64_t>(ranks.extent(0));
    // So that the places need less memory than the points.
    const std::int64_t length = std::max(4096, num_ranks);
    const std::int64_t num_blocks = count / length + 1;
    const std::int64_t num_places = num_ranks * num_blocks;
    const auto places =
        device.template lend_zeros<std::int64_t>(static_cast<std::size_t>(num_places));
    ListBlock list{ranks.data(), count, length, num_blocks, places.data(), nullptr};
    Kokkos::parallel_for("rrcb::count_by_rank", device.range(num_blocks), list);
    Kokkos::parallel_scan(
        "rrcb::places", device.range(num_places),
        KOKKOS_LAMBDA(const std::int64_t k, std::int64_t& before, const bool is_final) {
            const std::int64_t number = places(k);
            if (is_final) places(k) = before;
            before += number;
        });
    list.order = order.data();
    Kokkos::parallel_for("rrcb::list_by_rank", device.range(num_blocks), list);
    std::vector<std::int64_t> ends(static_cast<std::size_t>(num_ranks));
    const auto view = device.template lend<std::int64_t>(ends.size());
    Kokkos::parallel_for(
        "rrcb::ends", device.range(num_ranks), KOKKOS_LAMBDA(const std::int64_t rank) {
            // Each place is now the end of its list.
            view(rank) = places((rank + 1) * num_blocks - 1);
        });
    device.copy_out(view, std::span(ends));
    device.fence();
    return ends;
}

}  // namespace rrcb::detail
