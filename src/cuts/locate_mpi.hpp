#pragma once

#include "collective/participant.hpp"

#include <rrcb/locate.hpp>

#include <vector>

namespace rrcb {

/// As the public function, over a communicator that is a duplicate already. A failure from before
/// the call is thrown on all ranks as well.
std::vector<Part> locate(const Cuts& cuts, const Points& positions, Participant& self);

}  // namespace rrcb
