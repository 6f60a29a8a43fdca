#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>

#include <vector>

namespace rrcb {

/// As the public function, over a duplicated communicator. An earlier failure on one rank is thrown
/// on all.
std::vector<Part> assign_all(const Cuts& cuts, const Points& points, Participant& self);

}  // namespace rrcb
