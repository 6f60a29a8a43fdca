#pragma once

#include "../support/common.hpp"
#include "../support/ranks.hpp"

namespace rrcb::test {

/// From rank, index there, to rank, part: what a list says of one point.
using Transfer = std::array<int, 4>;

/// Transfers of all ranks, ascending. Collective.
inline std::vector<Transfer> gathered(const std::vector<Transfer>& mine) {
    std::vector<int> sizes(static_cast<std::size_t>(num_ranks()));
    const auto size = static_cast<int>(4 * mine.size());
    MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD);
    std::vector<int> starts(sizes.size());
    std::exclusive_scan(sizes.begin(), sizes.end(), starts.begin(), 0);
    std::vector<Transfer> all(static_cast<std::size_t>(starts.back() + sizes.back()) / 4);
    MPI_Allgatherv(mine.data(), size, MPI_INT, all.data(), sizes.data(), starts.data(), MPI_INT,
                   MPI_COMM_WORLD);
    std::ranges::sort(all);
    return all;
}

}  // namespace rrcb::test
