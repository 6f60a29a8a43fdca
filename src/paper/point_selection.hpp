#pragma once

#include <rrcb/detail/paper_steps.hpp>

#include <span>

namespace rrcb {

/// Throws Error if options of the sampling are out of range.
void check_sampling(const PaperOptions& options);

/// Throws Error for sizes that are illegal in Options::part_sizes.
void check_sizes(int num_parts, std::span<const double> part_sizes);

double weight_of(std::span<const MassPoint> points);

/// Divides points in place; the points below the cut come first. Returns their number. The expected
/// cost is linear in the number of points.
///
/// The cut is across `cut.axis` and has the weight `target` below it. The target is at least 0 and
/// less than the weight of all points. Points on the cut are divided along the other axes in
/// ascending order, unless `plain`; coincident points go to the side with the smaller error. The
/// cut is halfway between two points, or on the first point above it if the target divides that
/// point.
std::size_t select_below(std::span<MassPoint> points, int dimension, double target, bool plain,
                         Cut& cut);

}  // namespace rrcb
