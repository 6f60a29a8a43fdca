#pragma once

#include "collective/participant.hpp"

#include <span>

namespace rrcb {

/// Adds up what the parts weigh on all ranks, on every rank; returns their imbalance.
///
/// Collective: a reduction and a broadcast, which tell of failures as well; throws where a rank has
/// failed. `here` holds the weights of this rank's points and one more entry, `sums` gets those of
/// all and has two more.
double add_up_parts(std::span<double> here, std::span<double> sums,
                    std::span<const double> part_sizes, const Participant& self);

}  // namespace rrcb
