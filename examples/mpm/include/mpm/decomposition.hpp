#pragma once

#include <mpi.h>
#include <mpm/vector.hpp>

#include <functional>
#include <span>
#include <vector>

namespace mpm {

/// Division of space among the ranks.
///
/// In two dimensions the boxes hold 0 along the third axis. The closed boxes cover the grid and
/// share at most their faces. A point on a face may be with either side; it stays where it is until
/// it has left its owner's closed box.
struct Decomposition {
    /// One box per rank, the same on every rank.
    std::vector<Box> boxes;

    /// Owner rank of each position, whose closed box holds it. Not collective. The simulation asks
    /// for points that have left their box, and for all after a rebalance without `local_owners`.
    std::function<void(Positions, std::span<int>)> owners;

    /// Optional: owners of the positions that the balancer was called with, in their order. Some
    /// balancers divide ties on a cut between both sides, which no look-up can repeat.
    std::vector<int> local_owners;
};

/// A division of the points of all ranks. Collective over the communicator.
using Balancer = std::function<Decomposition(Positions, MPI_Comm)>;

/// Owners by closed boxes; a position on a face is with the first of them.
Decomposition within(const std::vector<Box>& boxes);

/// Slabs of equal width across the longest extent, one per rank, whatever they hold.
Decomposition slabs(const Box& extent, int num_ranks);

}  // namespace mpm
