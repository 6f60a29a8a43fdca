#pragma once

#include <rrcb/detail/moments.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Weight spread over a box, along each axis independently; at one position if `lower` equals
/// `upper`.
///
/// Along an axis the density, relative to its mean, is 1 + slope u + bow (3 u^2 - 1) / 2 >= 0 with
/// u from -1 at `lower` to 1 at `upper`: the first Legendre polynomials. So slope / 3 is the mean
/// of u, and the variance of u is 1/3 + 2/15 bow - slope^2 / 9.
struct Patch {
    Vector lower{};     ///< least coordinates
    Vector upper{};     ///< greatest coordinates
    double weight = 0;  ///< of all points in it
    Vector slope{};     ///< of the density, per axis
    Vector bow{};       ///< of the density, per axis
};

/// The approximation of all points that the root bisects, made of patches.
struct StatisticalDomain {
    int dimension = 0;             ///< of the points
    std::vector<Patch> patches{};  ///< in any order; they may overlap
};

/// Returns a patch per cell, or a few, with the cell's mean and standard deviation. Not collective.
///
/// @param cells     moments; if all weights are 0 the counts take their place
/// @param dimension of the points
/// @param box       of all points: a cell counts as far as it is in the box; a mean outside is
/// moved to the face, and sigma is at most that of points at both faces
///
/// Along an axis the density is quadratic on the longest interval inside the cell on which it is
/// nowhere negative: to second order the density of greatest entropy. If there is none, two uniform
/// densities replace it: between the mean and both faces or, if sigma is greater still, at both
/// faces.
RRCB_API StatisticalDomain analytic_domain(std::span<const CellMoments> cells, int dimension,
                                           const Box& box);

}  // namespace rrcb
