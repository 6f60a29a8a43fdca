#pragma once

#include "failure_mpi.hpp"

#include <mpi.h>

#include <numeric>
#include <type_traits>
#include <vector>

namespace comparisons {

/// Items of all ranks, in the order of the ranks, on rank 0; at most 2 GiB. Collective.
template <typename Item>
std::vector<Item> gather_on_root(const std::vector<Item>& mine, MPI_Comm comm) {
    static_assert(std::is_trivially_copyable_v<Item>);
    const int rank = rank_of(comm);
    const int size = size_of(comm);
    const int bytes = static_cast<int>(mine.size() * sizeof(Item));
    std::vector<int> counts(static_cast<std::size_t>(size));
    MPI_Gather(&bytes, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
    std::vector<int> starts(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    const auto sum = static_cast<std::size_t>(starts.back() + counts.back());
    std::vector<Item> all(rank == 0 ? sum / sizeof(Item) : 0);
    MPI_Gatherv(mine.data(), bytes, MPI_BYTE, all.data(), counts.data(), starts.data(), MPI_BYTE, 0,
                comm);
    return all;
}

}  // namespace comparisons
