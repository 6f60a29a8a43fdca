#pragma once

#include "collective/participant.hpp"
#include "search/correction.hpp"
#include "search/part_sums_mpi.hpp"

#include <memory>
#include <span>
#include <vector>

namespace rrcb {

/// Corrects all cuts at once by what lies in slabs about them.
///
/// The constructor makes what the messages need.
class Correction {
  public:
    /// For the tree below `top`; `memory` is borrowed. Not collective. Throws std::bad_alloc.
    Correction(const Descent& top, bool is_root, UndecidedPoints& memory);

    /// Moves `cuts`, whose parts are too uneven, until these are within the tolerance, as counted;
    /// or until that gets on no further. Returns in how many rounds, 0 where nothing was moved.
    ///
    /// Collective: two reductions and two broadcasts for each of 4 corrections at most. `parts` and
    /// `sums` hold what the cuts make, before and after, and `imbalance` that of the sums. All
    /// arguments but `points`, `parts` and the sums of this rank are the same on every rank. What
    /// fails on one rank, before or here, is thrown on all, unless nothing is moved.
    int run(const TargetRule& rule, const Points& points, std::span<const Bracket> brackets,
            Cuts& cuts, std::span<Part> parts, PartSums& sums, double& imbalance,
            Participant& self);

  private:
    void correct_together(const TargetRule& rule, const PartSums& sums, Cuts& cuts,
                          Participant& self);
    void move(Cuts& cuts) const;

    SlabTotals totals_;
    std::vector<Slab> slabs_;  ///< of all cuts; none where there are too many
    UndecidedPoints& points_;
    std::unique_ptr<double[]> here_;    ///< in bins of slabs, and 1 where this rank failed
    std::unique_ptr<double[]> joined_;  ///< the same of all ranks; null elsewhere than at the root
    std::vector<double> values_;        ///< of moving cuts, and how many ranks failed
    std::vector<double> expected_;      ///< weights of the parts once the cuts have moved
};

}  // namespace rrcb
