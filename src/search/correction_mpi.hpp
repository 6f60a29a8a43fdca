#pragma once

#include "collective/participant.hpp"
#include "search/collected_tree.hpp"
#include "search/part_sums_mpi.hpp"
#include "search/slab_counts.hpp"

#include <memory>
#include <span>
#include <vector>

namespace rrcb {

/// Corrects all cuts at once by the points in slabs about them.
///
/// The constructor makes the buffers of the messages.
class Correction {
  public:
    /// Takes the root of the tree; `memory` is borrowed. Not collective. Throws std::bad_alloc.
    Correction(const Descent& top, bool is_root, OpenPoints& memory);

    /// Moves `cuts`, whose parts are too uneven, until the counted parts are within the tolerance
    /// or no longer improve. Returns the number of rounds, 0 if nothing was moved.
    ///
    /// Collective: two reductions and two broadcasts for each of a few corrections. The parts of
    /// the points and `sums` belong to the cuts, before and after, and `imbalance` is that of the
    /// sums. All arguments except `points` and the sums of this rank are the same on every rank. A
    /// failure on one rank, before or here, is thrown on all, unless nothing is moved.
    int run(const TargetRule& rule, PointPasses& points, std::span<const Bracket> brackets,
            Cuts& cuts, PartSums& sums, double& imbalance, Participant& self);

  private:
    void correct_together(const TargetRule& rule, const PartSums& sums, Cuts& cuts,
                          Participant& self);
    void move(Cuts& cuts) const;

    SlabTotals totals_;
    std::vector<Slab> slabs_;  ///< of all cuts
    OpenPoints& points_;
    std::unique_ptr<double[]> here_;    ///< weights in bins of slabs, then 1 if this rank failed
    std::unique_ptr<double[]> joined_;  ///< the sums of `here_` over all ranks; null except on the
                                        ///< root
    std::vector<double> values_;        ///< of moving cuts, then how many ranks failed
    std::vector<double> expected_;      ///< weights of the parts after the move
};

}  // namespace rrcb
