#pragma once

#include <vector>

#include <rrcb/support_mesh.hpp>

namespace rrcb {

/// Count, weight, centroid and second central moment of a set of points.
///
/// `mean[a]` is sum(w x) / sum(w) and `central[a]` is sum(w (x - mean)^2), so that the standard
/// deviation is sqrt(central / weight). Points that all weigh 0 have the moments of the same
/// points with weight 1, and weight 0.
struct Moments {
    GlobalCount count = 0;
    double weight = 0;
    Vector mean{};
    Vector central{};
};

/// The moments of the points in one cell of a support mesh.
struct CellMoments {
    LocalIndex cell = 0;  ///< number in the mesh
    Box box;              ///< of the cell
    Moments moments;
};

/// Standard deviation per axis; 0 where the moments hold one point or none.
Vector standard_deviation(const Moments& moments);

/// Moments of the union of two disjoint sets of points.
///
/// Chan, Golub, LeVeque: Updating formulae and a pairwise algorithm for computing sample
/// variances (1979), equations 2.1, with weights in place of counts.
Moments merge(const Moments& a, const Moments& b);

/// Moments of every non-empty cell of `mesh`, in the order of the cells. Not collective.
///
/// One pass over the points, which must lie in the box of the mesh and be finite. Differences are
/// taken from a position within the cell, so the offset of the cloud costs no digits.
std::vector<CellMoments> cell_moments(const Points& points, const SupportMesh& mesh);

}  // namespace rrcb
