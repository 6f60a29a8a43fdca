#pragma once

#include "estimate/decision_mpi.hpp"
#include "passes/host_passes.hpp"
#include "search/refinement_mpi.hpp"

#include <rrcb/balance.hpp>

#include <optional>
#include <span>

namespace rrcb {

/// Makes the parts, from the cuts of rank 0 or by a search of many ranks, with buffers made before
/// the first message.
class Settlement {
  public:
    /// Makes the buffers; `counts` if parts are counted even if the cuts are kept. Borrows the
    /// complete `options`. Not collective. Throws Error or std::bad_alloc.
    void prepare(const Options& options, bool is_spread, bool counts, const Participant& self);

    /// Assigns the points by unchanged cuts; if `counts`, counts the parts. Collective.
    void assign(PointPasses& points, bool counts, Balance& result, Participant& self);

    /// Takes the counts of the parts on this rank and on all ranks.
    void take_counts(std::span<const double> here, std::span<const double> sums);

    /// Moves the cuts by counts of all ranks, and assigns the points by them. Collective.
    void refine(PointPasses& points, const Box& box, Decision& decision, Balance& result,
                Participant& self);

    /// Makes the parts by a search of many ranks. Collective.
    void search(HostPasses& points, const Verdict& verdict, Balance& result, Participant& self);

  private:
    const Options* options_ = nullptr;
    PartSums sums_;
    std::optional<Refinement> refinement_;     ///< if cuts of rank 0 may move
    std::optional<SpreadRefinement> of_many_;  ///< if many ranks make the parts
};

/// Gives each rank the cuts by Options::cuts after many ranks made the parts; with all cuts also
/// the weights of all parts.
///
/// Collective: two reductions for all cuts. No messages for HeldCuts::own, unless coincident points
/// are divided: then as assign_all(), because look-ups find the upper side of a cut.
void hold_cuts(HostPasses& points, const Options& options, Balance& result, Participant& self);

}  // namespace rrcb
