#pragma once

#include <mpm/parameters.hpp>
#include <mpm/vector.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mpm {

/// A background grid of square or cubic cells.
struct GridShape {
    Vector lower{};      ///< m
    double spacing = 1;  ///< m
    std::array<int, 3> num_cells{};

    Vector upper() const {
        return {lower[0] + num_cells[0] * spacing, lower[1] + num_cells[1] * spacing,
                lower[2] + num_cells[2] * spacing};
    }
};

/// Returns whether a body contains a position.
using Region = std::function<bool(const Vector&)>;

/// Returns the velocity in m/s at a position. An empty function means that the body is at rest.
using VelocityField = std::function<Vector(const Vector&)>;

/// A body filled with material points. They form a lattice: each is at the centre of one of the
/// equal parts of a cell.
///
/// A body is half-open: it takes points on its lower sides, and none on its upper sides. Bodies
/// that touch therefore share no point, and the number of points does not depend on where the sides
/// are.
struct Body {
    Region contains;
    std::array<int, 3> points_per_cell{2, 2, 2};
    std::string material;
    VelocityField velocity = {};  ///< velocity at the start
    std::string name = {};        ///< name, for messages of errors
    Box bounds = everywhere;      ///< box around the body; infinite if it is unknown
};

/// A material: the name of its model and the parameters; see material.hpp.
struct Material {
    std::string name;
    std::string model;
    Parameters parameters;
};

/// A side of the domain.
struct Wall {
    enum Kind {
        open,       ///< free; a point that passes it leaves the scene
        roller,     ///< no velocity normal to the wall
        fixed,      ///< no velocity
        frictional  ///< no velocity into the wall, and Coulomb friction along it
    };

    Wall(Kind the_kind = open, double the_friction = 0) : kind(the_kind), friction(the_friction) {}

    Kind kind;
    double friction;  ///< Coulomb's coefficient of a frictional wall
};

struct Walls {
    Wall left = {}, right = {};  ///< walls normal to x
    Wall bottom = {}, top = {};  ///< walls normal to y
    Wall back = {}, front = {};  ///< walls normal to z
};

/// A plane through the domain with solid ground behind it. It repels points, with friction along
/// it.
struct Plane {
    std::string name;
    Vector point{};       ///< on the plane, m
    Vector normal{};      ///< points out of the ground, of any length
    double friction = 0;  ///< Coulomb's coefficient
};

/// An effect: its name and its parameters; see effect.hpp.
struct Effect {
    std::string name;
    Parameters parameters;
};

/// A probe: the motion and stress of the point that is nearest to `position` at the start are
/// recorded.
struct Probe {
    std::string name;
    Vector position{};  ///< m
};

enum class ShapeFunction {
    linear,    ///< 2 nodes along an axis
    quadratic  ///< B-spline, 3 nodes
};

/// A scene, in SI units.
///
/// Only the effects that are named are built. Two-dimensional scenes are in plane strain, with
/// masses and forces per metre of depth. The y axis points up.
struct Scene {
    std::string name;
    int dimension = 2;
    GridShape grid;
    std::vector<Material> materials;
    std::vector<Body> bodies;
    Walls walls = {};
    std::vector<Plane> planes = {};
    std::vector<Effect> effects = {};
    std::vector<Probe> probes = {};

    ShapeFunction shape_function = ShapeFunction::linear;
    double courant_number = 0.4;  ///< time step * (wave speed + fastest speed) / grid spacing
    double end_time = 0;          ///< s
};

/// Returns the scene's effect of this name, or null if there is none.
const Effect* find_effect(const Scene& scene, const std::string& name);

/// Checks a scene. Throws std::invalid_argument with a text that describes the fault.
void validate(const Scene& scene);

}  // namespace mpm
