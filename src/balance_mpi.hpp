#pragma once

#include "collective/participant.hpp"
#include "options/validation.hpp"

#include <rrcb/passes.hpp>

#include <vector>

namespace rrcb {

/// Returns the machines of the parts of a call. Collective as mpi::machines_of().
Ranks ranks_of(Participant& self);

/// Balances as the public functions do, over a communicator already duplicated.
///
/// `previous` may be null. An earlier failure on one rank is thrown on all. Points that are
/// balanced well enough are kept (Report::kept) only if all ranks allow it: `may_keep` may differ
/// between them. Reuses `memory` for the parts.
Balance balance(const Points& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self, std::vector<Part> memory = {});

/// Balances points behind passes, which keep the parts.
Balance balance(PointPasses& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self);

/// Returns null for empty cuts, from which no call starts.
inline const Cuts* given(const Cuts& previous) {
    return previous.empty() ? nullptr : &previous;
}

}  // namespace rrcb
