#pragma once

#include <rrcb/detail/bisection.hpp>
#include <rrcb/detail/moments.hpp>
#include <rrcb/paper.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Weight concentrated at a position.
struct MassPoint {
    Vector position{};  ///< of the weight
    double weight = 0;  ///< of the point
};

/// Draws pseudo-random points of weight 1, uniformly in mean +- multiplier * sigma of each cell.
/// Not collective.
///
/// @param cells     of all ranks
/// @param dimension of the points
/// @param options   multiplier, share and seed; the same options give the same points on every
/// machine
/// @return `sample_fraction` times the number of real points, but at least one; they are shared
/// among the cells in proportion to their weight by the method of largest remainders
/// Throws Error for options out of range.
std::vector<MassPoint> sample_points(std::span<const CellMoments> cells, int dimension,
                                     const PaperOptions& options);

/// Copies points with their weights; if all weights are 0, each copy weighs 1. Not collective.
/// Throws Error for arrays of another length than the points.
std::vector<MassPoint> mass_points(const Points& points);

/// Bisects points recursively across the longest extent of the points in each box. Not collective.
///
/// @param points     a copy, which is sorted
/// @param dimension  of the points
/// @param num_parts  1 or more
/// @param part_sizes relative, one per part, or empty; a part of size 0 gets an empty region
/// @param rule       position of cuts
/// @param plain_cuts points on a cut are not divided by their other coordinates
/// Throws Error as bisect().
Bisection bisect_points(std::vector<MassPoint> points, int dimension, int num_parts,
                        std::span<const double> part_sizes = {},
                        CutRule rule = CutRule::weighted_fraction, bool plain_cuts = false);

}  // namespace rrcb
