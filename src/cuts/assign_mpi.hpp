#pragma once

#include "collective/participant.hpp"

#include <rrcb/cuts.hpp>

#include <vector>

namespace rrcb {

/// As the public function, over a communicator that is a duplicate already. A failure from before
/// the call is thrown on all ranks as well.
std::vector<Part> assign_all(const Cuts& cuts, const Points& points, Participant& self);

}  // namespace rrcb
