#pragma once

#include <mpm/decomposition.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mpm {

/// Background grid of square cells.
struct GridShape {
    Vector lower{};      ///< m
    double spacing = 1;  ///< m
    std::array<int, 2> num_cells{};

    Vector upper() const {
        return {lower[0] + num_cells[0] * spacing, lower[1] + num_cells[1] * spacing};
    }
};

/// Material points on a lattice, at the centres of equal parts of the grid's cells.
struct Body {
    std::function<bool(double x, double y)> contains;
    std::array<int, 2> points_per_cell{2, 2};
    double density = 1;                                       ///< kg/m^3
    std::function<Vector(double x, double y)> velocity = {};  ///< m/s at the start; none: at rest
};

struct Elastic {
    double youngs_modulus = 0;  ///< Pa
    double poissons_ratio = 0;

    double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poissons_ratio)); }
    double shear_modulus() const { return youngs_modulus / (2 * (1 + poissons_ratio)); }
    /// Speed of pressure waves in m/s.
    double wave_speed(double density) const;
};

/// Strength in terms of Mohr-Coulomb; flows at constant volume (angle of dilation 0).
struct MohrCoulomb {
    double cohesion = 0;         ///< Pa
    double friction_angle = 0;   ///< degrees
    double tension_cut_off = 0;  ///< Pa, mean stress; the cone's apex where that is less
};

/// A force against the motion, rate * momentum, until a time.
struct Damping {
    double rate = 0;   ///< 1/s
    double until = 0;  ///< s
};

enum class Wall {
    open,    ///< free; a point that reaches it has left the grid, which is an error
    roller,  ///< no velocity across the wall
    fixed    ///< no velocity
};

struct Walls {
    Wall left = Wall::open;
    Wall right = Wall::open;
    Wall bottom = Wall::open;
    Wall top = Wall::open;
};

/// All a simulation needs to know, in SI units and plane strain. An effect left out is not built.
struct Scene {
    std::string name;
    GridShape grid;
    std::vector<Body> bodies;
    Walls walls;
    Elastic elastic;
    std::optional<MohrCoulomb> mohr_coulomb = {};
    std::optional<Vector> gravity = {};  ///< m/s^2
    std::optional<Damping> damping = {};

    /// Share of the velocity that is carried by the points (FLIP); the rest is read back from the
    /// grid (PIC) and filters what the grid cannot see. One per cent of PIC calms cell-crossing
    /// noise within 0.2 s at the slope's step and leaves waves longer than a few cells alone.
    double flip_fraction = 0.99;
    double courant_number = 0.5;  ///< time step * (wave speed + point speed) / grid spacing
    double end_time = 0;          ///< s
};

/// Throws std::invalid_argument that names what is wrong with a scene.
void validate(const Scene& scene);

}  // namespace mpm
