#pragma once

#include "cells/binned_points.hpp"
#include "collective/butterfly_mpi.hpp"
#include "collective/participant.hpp"
#include "refinement/refinement_mpi.hpp"
#include "refinement/region_search.hpp"

#include <span>

namespace rrcb {

/// Makes the parts below regions, see RegionSearch. What the messages need is made before the first
/// of them.
class RegionRefinement {
  public:
    /// Not collective. Throws std::bad_alloc.
    RegionRefinement(int rank, int num_ranks);

    /// Finds the cuts below `regions`, of which each rank gets those that it knows, and writes the
    /// part of each point into `parts`.
    ///
    /// Collective. `regions` and `tree` are the same on every rank. To a tolerance that is missed,
    /// because slack was spent on upper levels that lower ones need, it searches once more,
    /// exactly and without the regions, and keeps the better cuts. Throws on every rank what failed
    /// on one, before or here; but a failure in the last messages stays with its rank for the next
    /// agreement.
    Refined refine(const Regions& regions, RegionTree tree, const BinnedPoints& binned,
                   std::span<Part> parts, Participant& self);

    ButterflyMessages& messages() { return messages_; }

  private:
    Refined search(const Regions& regions, const RegionTree& tree, SortedPoints& points,
                   std::span<Part> parts, Participant& self);

    Butterfly butterfly_;
    ButterflyMessages messages_;
};

}  // namespace rrcb
