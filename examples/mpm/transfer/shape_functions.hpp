#pragma once

#include "grid/grid.hpp"

#include <array>
#include <cstddef>

namespace mpm {

/// Shape functions of the nodes along one axis at one point, from the lowest node on.
template <std::size_t N>
struct Weights {
    std::array<double, N> value{};
    std::array<double, N> slope{};  ///< per cell
};

/// Two nodes to a point.
struct LinearShape {
    static constexpr std::size_t num_nodes = 2;
    static constexpr int margin = 0;

    /// Lowest node of a coordinate.
    int first_node(const GridShape& shape, double coordinate, std::size_t axis) const {
        return cell_of(shape, coordinate, axis);
    }

    /// Weights at `u` cells from the lowest node.
    ///
    /// On a face both stay above 0. The slopes need the velocities of both nodes there, and a node
    /// without mass has no velocity.
    Weights<2> at(double u) const {
        const double above = u > least ? u : least;
        const double inside = above < most ? above : most;
        return {{1 - inside, inside}, {-1, 1}};
    }

    /// Bounds of the upper weight. As constants compilers would make branches of them, which keep
    /// loops over points from vectors.
    double least = 1e-12, most = 1 - 1e-12;
};

/// Quadratic B-spline (Steffen, Kirby and Berzins 2008): smooth gradients, so that points
/// cross cells without noise.
struct QuadraticShape {
    static constexpr std::size_t num_nodes = 3;
    static constexpr int margin = 1;

    /// Lowest of the three nodes around the nearest one.
    int first_node(const GridShape& shape, double coordinate, std::size_t axis) const {
        const double cells_per_metre = 1 / shape.spacing;
        return static_cast<int>((coordinate - shape.lower[axis]) * cells_per_metre + 0.5) - 1;
    }

    Weights<3> at(double u) const {
        const double d = u - 1;
        return {{0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d)},
                {d - 0.5, -2 * d, d + 0.5}};
    }
};

}  // namespace mpm
