#pragma once

#include "collective/participant.hpp"
#include "zoltan/call/vote_mpi.hpp"
#include "zoltan/handle/part_map.hpp"
#include "zoltan/handle/state.hpp"

#include <vector>

namespace rrcb::zoltan {

/// Ranks and sizes of the parts.
struct Layout {
    PartMap map;
    std::vector<double> part_sizes;  ///< relative; empty: equal
};

/// Returns the layout that the ranks together ask for.
///
/// Collective only if NUM_LOCAL_PARTS or part sizes are set on any rank. If the numbers of parts do
/// not add up, throws the same ZoltanError on all ranks. Other errors are held back in `self`.
Layout make_layout(const Outcome& outcome, const State& state, Participant& self);

}  // namespace rrcb::zoltan
