#pragma once

#include "grid/grid.hpp"

#include <rrcb/neighbours.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace mpm {

/// Lists the nodes that the points of several ranks may reach.
///
/// Ranks whose boxes touch the same cells list the nodes of these cells for each other. Above the
/// water in a tank most of them are reached by no point; rrcb::Neighbours::sum does not send these.
template <int D>
class GhostNodes {
  public:
    /// Finds the ranks that share nodes, by the ranges of all ranks' boxes. Not collective.
    GhostNodes(std::span<const NodeRange<D>> ranges, int rank);

    /// Assigns numbers to the nodes of this rank's patch, which is a part of its range. Not
    /// collective. Call it whenever the nodes of the patch have changed.
    void number(const GridPatch<D>& patch);

    /// Returns the sums of the nodes, 1 + 2 D numbers for each. Counts the nodes that this rank
    /// shares and that its points reach.
    std::span<double> sums_of(GridPatch<D>& patch);

    /// Returns the nodes of the patch in the order in which each pair of ranks lists them.
    const rrcb::SharedEntries& shared() const { return shared_; }
    /// Returns the number of nodes that the last sums_of() has counted.
    std::size_t num_shared() const { return num_shared_; }

  private:
    std::vector<int> ranks_;            ///< ranks that share nodes with this one, ascending
    std::vector<NodeRange<D>> ranges_;  ///< the nodes shared with each of them
    rrcb::SharedEntries shared_;        ///< the same nodes, as numbers in the patch
    std::vector<std::size_t> common_;
    std::size_t num_shared_ = 0;
};

}  // namespace mpm
