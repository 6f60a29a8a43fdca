#pragma once

#include "grid/grid.hpp"

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

namespace mpm {

/// Nodes that the points of this rank and of others may reach, and their sums.
///
/// Ranks whose boxes touch the same cells are neighbours. A message has only the nodes that points
/// of its sender reach, as runs of consecutive nodes of the two boxes' common range: next to water
/// in a tank most of that range is air.
template <int D>
class GhostNodes {
  public:
    /// Finds the neighbours from the ranges of nodes of all ranks' boxes. Not collective.
    GhostNodes(std::span<const NodeRange<D>> ranges, MPI_Comm comm);

    /// Numbers the nodes of this rank's patch, a part of its range. Not collective. Call it
    /// whenever the patch has other nodes.
    void number(const GridPatch<D>& patch);

    /// Sums the nodes over the ranks, sums and fields, to the same bits on all that reach them. One
    /// message goes to each neighbour. Collective over the neighbours.
    void sum(GridPatch<D>& patch);

    /// Nodes of the patch that a neighbour may reach, ascending.
    const std::vector<std::size_t>& common() const { return common_; }
    /// Nodes that this rank has sent to any other in the last sum.
    std::size_t num_shared() const { return reached_.size(); }

    /// Ranks that may reach a node of this one, ascending.
    const std::vector<int>& neighbours() const { return ranks_; }

  private:
    /// One neighbour, the nodes common with it, and the messages.
    struct Neighbour {
        NodeRange<D> range;
        std::vector<std::size_t> nodes;  ///< numbers in the patch, `nowhere` outside it
        std::vector<double> outgoing, incoming;
    };

    void receive_any(std::size_t width);
    void send_all(const GridPatch<D>& patch);
    void unpack(std::size_t neighbour, GridPatch<D>& patch) const;

    MPI_Comm comm_;
    int rank_;
    std::vector<int> ranks_;
    std::vector<Neighbour> neighbours_;
    std::vector<MPI_Request> requests_;
    std::vector<std::size_t> common_;
    std::vector<std::size_t> reached_;  ///< of common_, by the points of this rank
    std::vector<double> own_;           ///< this rank's contributions to them
};

}  // namespace mpm
