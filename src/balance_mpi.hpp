#pragma once

#include "collective/participant.hpp"
#include "options/validation.hpp"

#include <rrcb/detail/passes.hpp>

#include <vector>

namespace rrcb {

/// Returns the number of ranks and their machines. Collective as mpi::machines_of().
Ranks ranks_of(Participant& self);

/// Balances as the public functions do, over the duplicated communicator.
///
/// `previous` may be null. If a rank has failed before, throws its error on all ranks. Points that
/// are balanced well enough are kept (Report::kept) only if `may_keep` is true on all ranks; it may
/// differ between them. Reuses `memory` for the parts.
Balance balance(const Points& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self, std::vector<Part> memory = {});

/// As above, for points that are accessed by passes, which keep the parts.
Balance balance(PointPasses& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self);

/// Returns null if the cuts are empty, because no call can start from those.
inline const Cuts* given(const Cuts& previous) {
    return previous.empty() ? nullptr : &previous;
}

}  // namespace rrcb
