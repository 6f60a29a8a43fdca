#pragma once

#include "grid/grid.hpp"

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

namespace mpm {

/// Nodes that a rank's patch shares with those of other ranks, and their sums.
template <int D>
class GhostNodes {
  public:
    /// Finds the shared nodes from the patches of all ranks. Not collective.
    GhostNodes(std::span<const NodeRange<D>> patches, MPI_Comm comm);

    /// Sums the shared nodes over the ranks, sums and fields, to the same bits on all. One message
    /// goes to each neighbour. Collective over the neighbours.
    void sum(GridPatch<D>& patch);

    /// Nodes that this rank shares with any other.
    const std::vector<std::size_t>& shared() const { return shared_; }
    std::size_t num_shared() const { return shared_.size(); }

    /// Ranks that share a node with this one, ascending.
    const std::vector<int>& neighbours() const { return ranks_; }

  private:
    void exchange(const GridPatch<D>& patch);

    MPI_Comm comm_;
    int rank_;
    std::vector<int> ranks_;
    std::vector<std::vector<std::size_t>> nodes_;  ///< shared with each neighbour
    std::vector<std::vector<double>> outgoing_;    ///< one message per neighbour
    std::vector<std::vector<double>> incoming_;
    std::vector<MPI_Request> requests_;
    std::vector<std::size_t> shared_;  ///< nodes of the patch that any neighbour has
    std::vector<double> own_;          ///< this rank's contributions to the shared nodes
};

}  // namespace mpm
