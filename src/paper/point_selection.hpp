#pragma once

#include <rrcb/paper.hpp>

#include <span>

namespace rrcb {

double weight_of(std::span<const MassPoint> points);

/// Divides points in place: those below the cut come first. Expected cost linear in their number.
///
/// The cut across `axis` has the weight `target` below it, out of some weight > target >= 0 in all.
/// Points that share a coordinate with it are divided along the other axes in ascending order
/// unless the cut is to be `plain`; points that can't be told apart go to the side that is nearer
/// to the target. It lies halfway between two points; on the first point above it where the target
/// divides that one. Returns how many points lie below.
std::size_t select_below(std::span<MassPoint> points, int dimension, double target, bool plain,
                         Cut& cut);

}  // namespace rrcb
