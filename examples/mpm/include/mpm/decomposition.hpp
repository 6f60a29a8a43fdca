#pragma once

#include <mpi.h>
#include <mpm/vector.hpp>

#include <functional>
#include <span>
#include <vector>

namespace mpm {

/// A division of space among the ranks.
///
/// In two dimensions the boxes have the bounds 0 along the third axis. The closed boxes cover the
/// grid and overlap at most in their faces. A point on a face may belong to either side. It keeps
/// its owner until it has left the owner's closed box, and then belongs to the first box that
/// contains it.
struct Decomposition {
    /// One box per rank, the same on every rank.
    std::vector<Box> boxes;

    /// Writes the owner of each position, which is a rank whose closed box contains it. Not
    /// collective. The simulation calls it at its start. After a rebalance without `local_owners`
    /// it calls it for all points.
    std::function<void(Positions, std::span<int>)> owners;

    /// Optional: the owners of the positions passed to the balancer, in their order. Some balancers
    /// assign points on a cut to both sides; a look-up by position cannot reproduce that.
    std::vector<int> local_owners;
};

/// Divides the points of all ranks. Collective over the communicator.
using Balancer = std::function<Decomposition(Positions, MPI_Comm)>;

/// Returns a decomposition that looks up owners by closed boxes. A position on a face belongs to
/// the first box that contains it.
Decomposition within(const std::vector<Box>& boxes);

/// Returns slabs of equal width across the longest extent, one per rank, whatever points they
/// contain.
Decomposition slabs(const Box& extent, int num_ranks);

}  // namespace mpm
