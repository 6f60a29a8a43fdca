#pragma once

#include <rrcb/detail/moments.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Weight spread over a box, independently along each axis. If `lower` equals `upper`, the weight
/// is at one position.
///
/// Along an axis the density, relative to its mean, is 1 + slope u + bow (3 u^2 - 1) / 2 >= 0, with
/// u from -1 at `lower` to 1 at `upper`; these terms are the first Legendre polynomials. The mean
/// of u is therefore slope / 3, and its variance is 1/3 + 2/15 bow - slope^2 / 9.
struct Patch {
    Vector lower{};     ///< least coordinates
    Vector upper{};     ///< greatest coordinates
    double weight = 0;  ///< of all points in it
    Vector slope{};     ///< of the density, per axis
    Vector bow{};       ///< of the density, per axis
};

/// The approximation of all points that the root bisects. It consists of patches.
struct StatisticalDomain {
    int dimension = 0;             ///< of the points
    std::vector<Patch> patches{};  ///< in any order; they may overlap
};

/// Returns one or a few patches for each cell, with the cell's mean and standard deviation. Not
/// collective.
///
/// @param cells     moments; if all weights are 0, counts are used instead
/// @param dimension of the points
/// @param box       of all points: cells are clipped to it, a mean outside is moved to the face,
/// and sigma is at most that of points at both faces
///
/// Along an axis the density is quadratic, on the longest interval inside the cell on which it is
/// nowhere negative; to second order this is the density of greatest entropy. If there is no such
/// interval, two uniform densities are used instead: between the mean and both faces or, if sigma
/// is even larger, at both faces.
StatisticalDomain analytic_domain(std::span<const CellMoments> cells, int dimension,
                                  const Box& box);

}  // namespace rrcb
