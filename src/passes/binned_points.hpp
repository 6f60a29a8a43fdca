#pragma once

#include <rrcb/method/moments.hpp>

#include <vector>

namespace rrcb {

/// Sums of w d and w d^2 over points, d relative to an origin in or near their cell, in scaled
/// lengths.
template <std::size_t Dimension>
struct MomentSums {
    std::array<double, Dimension> first{};
    std::array<double, Dimension> second{};

    MomentSums& operator+=(const MomentSums& other) {
        for (std::size_t a = 0; a < Dimension; ++a) first[a] += other.first[a];
        for (std::size_t a = 0; a < Dimension; ++a) second[a] += other.second[a];
        return *this;
    }
};

/// Sums over one rank's points in each cell of a support mesh.
struct BinnedPoints {
    SupportMesh mesh;
    Points points;                   ///< borrowed
    std::vector<LocalIndex> counts;  ///< points in each cell of the mesh
    double weight_scale = 1;         ///< power of two that keeps sums of weighted squares in range
    std::vector<double> weights;     ///< of each cell, scaled; empty when every point weighs 1
    /// First point of each cell, in scaled lengths; like the sums `dimension` entries per cell.
    std::vector<double> origins;
    std::vector<double> first_moments;   ///< sum of w d over the points of a cell, d = x - origin
    std::vector<double> second_moments;  ///< sum of w d^2

    int dimension() const { return mesh.dimension; }
    double scaled_weight(LocalIndex cell) const {
        return weights.empty() ? static_cast<double>(counts[cell]) : weights[cell];
    }
};

/// Adds up finite points in the box of `mesh`, in one pass. Not collective.
BinnedPoints bin_by_cell(const Points& points, const SupportMesh& mesh);

/// Returns the moments of binned points, as the public function does.
std::vector<CellMoments> cell_moments(const BinnedPoints& binned);

}  // namespace rrcb
