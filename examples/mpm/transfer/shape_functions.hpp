#pragma once

#include "grid/grid.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mpm {

/// Values of the nodes' shape functions along one axis at one point, the lowest node first.
template <std::size_t N>
struct Weights {
    std::array<double, N> value{};
    std::array<double, N> slope{};  ///< per cell
};

/// Linear shape functions: a point has two nodes. Each has at least the least weight
/// (scene/light_nodes.hpp).
struct LinearShape {
    static constexpr std::size_t num_nodes = 2;
    static constexpr int margin = 0;
    /// with a larger one the weights would have no slope
    static constexpr double most_least_weight = 1.0 / 3;

    /// Keeps all weights above 0: slopes use the velocities of both nodes, and a node without mass
    /// has no velocity.
    explicit LinearShape(double least_weight = 0)
        : least(std::max(least_weight, 1e-12)), most(1 - least) {}

    /// Returns the lowest node of a coordinate.
    int first_node(const GridShape& shape, double coordinate, std::size_t axis) const {
        return cell_of(shape, coordinate, axis);
    }

    /// Returns the weights of a point that is `u` cells above the lowest node.
    Weights<2> at(double u) const {
        const double above = u > least ? u : least;
        const double inside = above < most ? above : most;
        return {{1 - inside, inside}, {-1, 1}};
    }

    /// Bounds of the upper weight. If they were constants, compilers would turn the comparisons
    /// into branches, which prevent the vectorization of loops over points.
    double least, most;
};

/// Quadratic B-splines (Steffen, Kirby and Berzins 2008). Their gradients are continuous, so that
/// points cross cells without noise. Each outer node has at least the least weight of a point.
struct QuadraticShape {
    static constexpr std::size_t num_nodes = 3;
    static constexpr int margin = 1;
    /// outer weights of a point at a node
    static constexpr double most_least_weight = 1.0 / 8;

    explicit QuadraticShape(double least_weight = 0) : least(least_weight) {}

    /// Returns the lowest of the three nodes around the nearest node.
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
