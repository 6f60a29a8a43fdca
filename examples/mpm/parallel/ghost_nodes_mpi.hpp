#pragma once

#include "grid/grid.hpp"

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

namespace mpm {

/// Sums the nodes that the points of several ranks may reach.
///
/// Ranks whose boxes touch the same cells are neighbours. A message contains only the nodes that
/// the sender's points reach, as runs of consecutive nodes in the range common to both boxes. This
/// matters because, above the water in a tank, for example, most of the range contains no points.
template <int D>
class GhostNodes {
  public:
    /// Finds the neighbours from the ranges of nodes of all ranks' boxes. Not collective.
    GhostNodes(std::span<const NodeRange<D>> ranges, MPI_Comm comm);

    /// Assigns numbers to the nodes of this rank's patch, which is a part of its range. Not
    /// collective. Call it whenever the nodes of the patch have changed.
    void number(const GridPatch<D>& patch);

    /// Sums the sums and fields of the nodes over the ranks. All ranks that reach a node get
    /// bit-identical results. One message is sent to each neighbour. Collective over the
    /// neighbours.
    void sum(GridPatch<D>& patch);

    /// Returns the number of nodes that this rank has sent to other ranks in the last sum.
    std::size_t num_shared() const { return reached_.size(); }

    /// Returns the ranks that may reach a node of this one, ascending.
    const std::vector<int>& neighbours() const { return ranks_; }

  private:
    /// A neighbour, the nodes shared with it, and the messages.
    struct Neighbour {
        NodeRange<D> range;
        std::vector<std::size_t> nodes;  ///< numbers in the patch; `nowhere` for nodes outside it
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
    std::vector<std::size_t> reached_;  ///< the nodes of common_ that this rank's points reach
    std::vector<double> own_;           ///< this rank's contributions to those nodes
};

}  // namespace mpm
