#pragma once

#include <rrcb/paper.hpp>

#include <span>

namespace rrcb {

double weight_of(std::span<const MassPoint> points);

/// Divides points in place: those below the cut come first. Expected cost linear in their number.
///
/// The cut across `axis` has the weight `target` below it, out of some weight > target >= 0 in all.
/// Points that share a coordinate with it are divided along the other axes in ascending order
/// unless the cut is to be `plain`; equal points go to the side that is nearer to the target. It is
/// halfway between two points, or on the first point above it if the target divides this one.
/// Returns the number of points below.
std::size_t select_below(std::span<MassPoint> points, int dimension, double target, bool plain,
                         Cut& cut);

}  // namespace rrcb
