#pragma once

#include <rrcb/paper.hpp>

#include <span>

namespace rrcb {

/// Throws Error for options of the sampling out of range.
void check_sampling(const PaperOptions& options);

/// Throws Error for sizes that Options::part_sizes could not be.
void check_sizes(int num_parts, std::span<const double> part_sizes);

double weight_of(std::span<const MassPoint> points);

/// Divides points in place, the ones below the cut first. Expected cost linear in their number.
///
/// The cut across `cut.axis` has the weight `target` below it, from 0 up to, not including, the
/// weight of all points. Points that share a coordinate with it are divided along the other axes in
/// ascending order, unless `plain`; equal points go to the side with the smaller error. The cut is
/// halfway between two points, or on the first point above it if the target divides this one.
/// Returns the number of points below.
std::size_t select_below(std::span<MassPoint> points, int dimension, double target, bool plain,
                         Cut& cut);

}  // namespace rrcb
