#pragma once

#include "flow_mpi.hpp"
#include "particles.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons {

/// One call of the library, or one part of the step of a hand-written code.
struct Stage {
    std::string name;
    std::function<void(Particles&)> call;  ///< collective
};

/// The stages of a step in their order. All stages before the last one move points to their ranks
/// and copy ghosts. The last stage adds the forces on ghosts to those on their points. In steps
/// that keep the ghosts only the last two stages are called, fetch and accumulate.
using Arm = std::vector<Stage>;

/// Returns the arm "loop", "neighbours" or "by-hand". Throws Failure for another name. Collective.
/// `flow` must outlive it.
Arm make_arm(std::string_view name, const Flow& flow);

/// Returns the arm with those calls of the library that can move points from any rank to any other.
Arm loop(const Flow& flow);

/// Returns the arm with the library's exchanges between neighbouring ranks.
Arm neighbours(const Flow& flow);

/// Returns a step as an author would write it for one program. The neighbours follow from the
/// boxes. Each neighbour gets one message per stage that contains all columns, and the buffers are
/// reused.
Arm by_hand(const Flow& flow);

}  // namespace comparisons
