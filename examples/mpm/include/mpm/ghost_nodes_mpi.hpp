#pragma once

#include <mpi.h>
#include <mpm/grid.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace mpm {

/// The nodes a rank's patch shares with those of other ranks, and their summation.
class GhostNodes {
  public:
    /// Finds the shared nodes from the patches of all ranks. Not collective.
    GhostNodes(std::span<const NodeRange> patches, MPI_Comm comm);

    /// Adds what the other ranks have on the shared nodes; collective over the neighbours.
    ///
    /// One message to each neighbour. Every rank adds the contributions to a node in ascending
    /// order of the ranks, so that all hold the same bits.
    void sum(GridPatch& patch);

    /// Ranks that share a node with this one, ascending.
    const std::vector<int>& neighbours() const { return ranks_; }

  private:
    void exchange(const GridPatch& patch);
    void take_out_own(GridPatch& patch);

    MPI_Comm comm_;
    int rank_ = 0;
    std::vector<int> ranks_;
    std::vector<NodeRange> ranges_;            ///< shared with each neighbour
    std::vector<std::vector<Node>> outgoing_;  ///< one message per neighbour
    std::vector<std::vector<Node>> incoming_;
    std::vector<MPI_Request> requests_;
    std::vector<std::size_t> shared_;  ///< nodes of the patch with any neighbour
    std::vector<Node> own_;            ///< this rank's contribution to them
};

}  // namespace mpm
