#pragma once

#include "method.hpp"

#include <mpm/decomposition.hpp>

#include <optional>
#include <vector>

namespace comparisons {

/// Coordinates of a simulation's points as a workload has them.
std::vector<double> interleaved(mpm::Positions positions);

/// A method as the simulation takes it; none when its parts are no boxes (RIB, HSFC).
///
/// Through Zoltan's callbacks, lists and look-ups, but for rrcb-arrays; with KEEP_CUTS=1 for the
/// look-ups and REMAP=0, as part p goes to rank p.
std::optional<mpm::Balancer> make_balancer(const Method& method);

}  // namespace comparisons
