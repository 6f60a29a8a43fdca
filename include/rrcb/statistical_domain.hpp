#pragma once

#include <rrcb/moments.hpp>
#include <rrcb/options.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Weight spread evenly over a box; a point where `lower` equals `upper`.
struct Patch {
    Vector lower{};
    Vector upper{};
    double weight = 0;
};

/// Weight in one place.
struct MassPoint {
    Vector position{};
    double weight = 0;
};

/// What the root bisects: an approximation of all points, made of patches or of points.
struct StatisticalDomain {
    int dimension = 0;
    std::vector<Patch> patches{};
    std::vector<MassPoint> points{};  ///< in place of patches
};

/// A uniform patch per cell, or a few, with the cell's mean and standard deviation. Not collective.
///
/// A patch reaches sqrt(3) sigma, the half-width of a uniform density, to both sides of the mean.
/// Two take its place along an axis where it would leave `box`, which holds all points, or the cell
/// by more than a quarter of the way from the mean to the nearer face: one ends at that face, both
/// at the mean. Where no such two inside the cell have that sigma, they may fill `box`; where none
/// inside `box` have, sigma becomes less. Where all weights are 0 the counts take their place.
RRCB_API StatisticalDomain analytic_domain(std::span<const CellMoments> cells, int dimension,
                                           const Box& box);

/// Pseudo-random points of equal weight, uniform in mean +- multiplier * sigma of each cell.
///
/// `sample_fraction` times the number of real points in all, shared out over the cells in
/// proportion to their weight by largest remainder, at least one point in all. The same cells,
/// options and seed give the same points on every machine. Not collective.
RRCB_API StatisticalDomain sampled_domain(std::span<const CellMoments> cells, int dimension,
                                          const Options& options);

/// The points themselves. Not collective.
RRCB_API StatisticalDomain point_domain(const Points& points);

}  // namespace rrcb
