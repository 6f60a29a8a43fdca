#pragma once

#include "balance_mpi.hpp"
#include "estimate/decision_mpi.hpp"
#include "passes/host_passes.hpp"
#include "settlement_mpi.hpp"

#include <optional>

// What calls from scratch and from earlier cuts share.

namespace rrcb {

/// A call on one rank.
struct Call {
    Call(PointPasses& given, StageObserver* observer, Participant& self)
        : points(given), host(dynamic_cast<HostPasses*>(&given)), ranks(ranks_of(self)) {
        options.observer = observer;
    }

    PointPasses& points;
    HostPasses* host;  ///< null if only passes read the points
    Ranks ranks;
    Options options;  ///< complete; sizes are normalized, but none if many ranks make equal parts
    bool is_spread = false;  ///< many ranks make the parts
    Contribution mine;
    Decision decision;
    Box box;  ///< of the points of this rank
    PartSums sums;
    std::optional<Refinement> refinement;  ///< if the cuts may move
    Balance result;
};

/// Completes the options, and summarizes them and the points for the other ranks. Not collective.
void introduce(const Options& given, const PointSummary& summary, const Cuts* previous, Call& call,
               const Participant& self);

/// Gives every rank the decision of rank 0, or throws the error of one rank on all. Collective.
void estimate(Call& call, Participant& self);

/// Gives every rank all cuts and the weights of all parts, after many ranks made the parts and each
/// has the cuts that it owns. Collective: two reductions with an entry for each part.
void hold_cuts(Call& call, Participant& self);

/// Replaces the ends of the tree by parts, and counts by weights; reports the points near cuts.
/// Overwrites the sizes of the parts. Not collective.
void complete(Call& call);

/// Balances without earlier cuts. Collective as balance().
Balance balance_from_scratch(PointPasses& points, const Options& given, bool may_keep,
                             Participant& self);

/// Keeps the earlier cuts if they are even enough, else moves them. Begins from scratch if the cuts
/// cannot be reused, or are uneven and many ranks make the parts. If the axes of the earlier cuts
/// may be poor by now, makes cuts from scratch as well and returns the better result. Collective.
Balance balance_from_earlier(PointPasses& points, const Options& given, const Cuts& previous,
                             bool may_keep, Participant& self);

}  // namespace rrcb
