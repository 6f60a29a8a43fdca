#pragma once

#include "flow_mpi.hpp"
#include "particles.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons {

/// One call, or a part of the step of a hand-written code.
struct Stage {
    std::string name;
    std::function<void(Particles&)> call;  ///< collective
};

/// The services of a step in their order. Those before the last bring points to their ranks and
/// copy ghosts; the last adds the forces on ghosts to those on their points. The last two, fetch
/// and accumulate, serve alone while ghosts are kept.
using Arm = std::vector<Stage>;

/// Names of the arms.
std::vector<std::string> arm_names();

/// Makes an arm; throws Failure for another name. Collective. `flow` must outlive it.
Arm make_arm(std::string_view name, const Flow& flow);

/// The calls of the library that take points from any rank to any other.
Arm loop(const Flow& flow);

/// The exchanges of the library with the ranks nearby.
Arm neighbours(const Flow& flow);

/// A step as its author would write it for one program: the neighbours are known from the boxes,
/// each gets one message in each stage with the columns side by side, and buffers are kept.
Arm by_hand(const Flow& flow);

}  // namespace comparisons
