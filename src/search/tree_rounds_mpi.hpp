#pragma once

#include "collective/butterfly_mpi.hpp"
#include "collective/participant.hpp"
#include "search/tree_search.hpp"

#include <optional>

namespace rrcb {

/// Runs the rounds of searches, with buffers made before the first message.
class TreeRounds {
  public:
    /// Not collective. Throws std::bad_alloc.
    TreeRounds(int rank, int num_ranks, Butterfly::Way way)
        : butterfly_(rank, num_ranks, TreeSearch::join, way) {}

    /// Ends a search, which this rank lacks if it has failed; returns the number of rounds.
    ///
    /// Collective: each round is a pass to the owners and one back, and a spread search ends with
    /// one to the owners. Throws on every rank the failure of one, before or here; but a failure in
    /// the last messages stays with its rank for the next agreement.
    int run(std::optional<TreeSearch>& search, Participant& self);

    /// Imbalance of all parts after a spread search; the same on every rank.
    double imbalance() const { return butterfly_.flags()[2]; }

    int rank() const { return butterfly_.rank(); }

  private:
    Butterfly butterfly_;
    ButterflyMessages messages_;
};

}  // namespace rrcb
