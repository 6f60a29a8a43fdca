#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>

#include <vector>

namespace rrcb {

/// Does the same as the public function, over a duplicated communicator. An earlier failure is
/// thrown on all ranks as well.
std::vector<Part> assign_all(const Cuts& cuts, const Points& points, Participant& self);

}  // namespace rrcb
