#pragma once

#include <mpi.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace mpm {

using Vector = std::array<double, 2>;

/// Closed axis-aligned box in metres; open sides are +-infinity, lower above upper is empty.
struct Box {
    Vector lower{};
    Vector upper{};
};

inline bool contains(const Box& box, double x, double y) {
    return x >= box.lower[0] && x <= box.upper[0] && y >= box.lower[1] && y <= box.upper[1];
}

/// Borrowed positions of material points in metres; both columns have the same length.
struct Positions {
    std::span<const double> x;
    std::span<const double> y;
};

/// Who owns which part of space.
///
/// The closed boxes cover the grid and share at most their faces. A point on a face may be with
/// either side; it stays where it is until it has left its owner's closed box.
struct Decomposition {
    /// One box per rank, the same on every rank.
    std::vector<Box> boxes;

    /// Owner rank of each position, whose closed box holds it. Not collective. Asked for points
    /// that have left their box, and for all points after a rebalance without `local_owners`.
    std::function<void(Positions, std::span<int>)> owners;

    /// Optional: owners of the very positions the balancer was called with, in their order. For
    /// balancers that divide ties on a cut between both sides, which no look-up can repeat.
    std::vector<int> local_owners;
};

/// Divides the points of all ranks anew; collective over the communicator.
using Balancer = std::function<Decomposition(Positions, MPI_Comm)>;

/// Slabs of equal width across the longest extent, one per rank, whatever they hold.
Decomposition slabs(const Box& extent, int num_ranks);

}  // namespace mpm
