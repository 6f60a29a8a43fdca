#pragma once

#include <rrcb/detail/support_mesh.hpp>

#include <vector>

namespace rrcb {

/// Count, weight, centroid and standard deviation along each axis of a set of points.
///
/// `mean[a]` is sum(w x) / sum(w) and `deviation[a]` is sqrt(sum(w (x - mean)^2) / sum(w)).
/// Deviations are lengths and not squares, so that they neither overflow nor vanish for any
/// coordinates.
struct Moments {
    GlobalCount count = 0;  ///< of the points
    double weight = 0;      ///< sum of their weights
    Vector mean{};          ///< centroid
    Vector deviation{};     ///< standard deviation per axis
};

/// The moments of the points in one cell of a support mesh.
struct CellMoments {
    LocalIndex cell = 0;  ///< number in the mesh
    Box box;              ///< of the cell
    Moments moments;      ///< of the points in it
};

/// Returns the moments of the union of two disjoint sets of points. Not collective.
///
/// @param a moments of one set
/// @param b moments of the other
///
/// Source: Chan, Golub, LeVeque: Updating formulae and a pairwise algorithm for computing sample
/// variances (1979), equations 2.1, with weights in place of counts. If neither set has weight,
/// counts are used and the weight remains 0.
Moments merge(const Moments& a, const Moments& b);

/// Returns the moments of every cell with weight, in the order of the cells. Not collective.
///
/// @param points finite and in the box of the mesh, which is not checked; in any order
/// @param mesh   of the dimension of the points
///
/// If all points weigh 0, their moments are computed as with weight 1, but their weight remains 0.
/// Throws Error for another dimension, arrays that do not fit together, or weights that are
/// negative, NaN or infinite.
///
/// Uses shifted sums (Chan, Golub, LeVeque: Algorithms for computing the sample variance, 1983,
/// section 3): about the first point of each cell, and again about the mean if that point is far
/// off. Neither large coordinates nor different weights cost more than one digit.
std::vector<CellMoments> cell_moments(const Points& points, const SupportMesh& mesh);

}  // namespace rrcb
