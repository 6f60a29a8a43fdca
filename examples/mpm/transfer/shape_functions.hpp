#pragma once

#include "grid/grid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mpm {

/// Shape functions of the nodes along one axis at one point, from the lowest node on.
template <std::size_t N>
struct Weights {
    std::array<double, N> value{};
    std::array<double, N> slope{};  ///< per cell
};

/// Two nodes to a point. None has less than the least weight of it (scene/light_nodes.hpp).
struct LinearShape {
    static constexpr std::size_t num_nodes = 2;
    static constexpr int margin = 0;
    static constexpr double most_least_weight = 1.0 / 3;  ///< more would leave no slope of weights

    /// The slopes need the velocities of both nodes, and a node without mass has no velocity:
    /// weights are above 0.
    explicit LinearShape(double least_weight = 0)
        : least(std::max(least_weight, 1e-12)), most(1 - least) {}

    /// Lowest node of a coordinate.
    int first_node(const GridShape& shape, double coordinate, std::size_t axis) const {
        return cell_of(shape, coordinate, axis);
    }

    /// Weights at `u` cells from the lowest node.
    Weights<2> at(double u) const {
        const double above = u > least ? u : least;
        const double inside = above < most ? above : most;
        return {{1 - inside, inside}, {-1, 1}};
    }

    /// Bounds of the upper weight. As constants compilers would make branches of them, which keep
    /// loops over points from vectors.
    double least, most;
};

/// Quadratic B-spline (Steffen, Kirby and Berzins 2008): smooth gradients, so that points
/// cross cells without noise. Neither outer node has less than the least weight of a point.
struct QuadraticShape {
    static constexpr std::size_t num_nodes = 3;
    static constexpr int margin = 1;
    static constexpr double most_least_weight = 1.0 / 8;  ///< that of a point above a node

    explicit QuadraticShape(double least_weight = 0) : least(least_weight) {}

    /// Lowest of the three nodes around the nearest one.
    int first_node(const GridShape& shape, double coordinate, std::size_t axis) const {
        const double cells_per_metre = 1 / shape.spacing;
        return static_cast<int>((coordinate - shape.lower[axis]) * cells_per_metre + 0.5) - 1;
    }

    Weights<3> at(double u) const {
        const double d = u - 1;
        const double spline_below = 0.5 * (0.5 - d) * (0.5 - d);
        const double spline_above = 0.5 * (0.5 + d) * (0.5 + d);
        const double below = spline_below > least ? spline_below : least;
        const double above = spline_above > least ? spline_above : least;
        return {{below, 1 - below - above, above}, {d - 0.5, -2 * d, d + 0.5}};
    }

    double least;
};

}  // namespace mpm
