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

/// Two nodes to a point.
///
/// A node that only points near a face reach is light, but as stiff as others, so explicit steps
/// would be unstable. Therefore a point counts as at least 3/4 C^2 of a cell from each face, where
/// C is the Courant number: the square of the node's frequency is then at most 4/3 per step. Forces
/// and strains use the same functions, so that this yields no energy.
struct LinearShape {
    static constexpr std::size_t num_nodes = 2;
    static constexpr int margin = 0;

    explicit LinearShape(double courant_number = 0)
        : least(std::clamp(0.75 * courant_number * courant_number, 1e-12, 0.5)), most(1 - least) {}

    /// Lowest node of a coordinate.
    int first_node(const GridShape& shape, double coordinate, std::size_t axis) const {
        return cell_of(shape, coordinate, axis);
    }

    /// Weights at `u` cells from the lowest node, both above 0: the slopes need the velocities of
    /// both nodes, and a node without mass has no velocity.
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
/// cross cells without noise.
struct QuadraticShape {
    static constexpr std::size_t num_nodes = 3;
    static constexpr int margin = 1;

    explicit QuadraticShape(double /*courant_number*/ = 0) {}

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
