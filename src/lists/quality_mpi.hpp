#pragma once

#include "collective/participant.hpp"

#include <rrcb/quality.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Returns the weight of each part over all ranks, as the public function, over a communicator that
/// is a duplicate already. Collective.
std::vector<double> part_weights(const Points& points, std::span<const Part> parts, int num_parts,
                                 Participant& self);

/// As moved_fraction().
double moved_fraction(const Points& points, std::span<const Part> parts, int num_parts,
                      Participant& self);

}  // namespace rrcb
