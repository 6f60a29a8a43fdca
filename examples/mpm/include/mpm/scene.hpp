#pragma once

#include <mpm/parameters.hpp>
#include <mpm/vector.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mpm {

/// Background grid of square or cubic cells.
struct GridShape {
    Vector lower{};      ///< m
    double spacing = 1;  ///< m
    std::array<int, 3> num_cells{};

    Vector upper() const {
        return {lower[0] + num_cells[0] * spacing, lower[1] + num_cells[1] * spacing,
                lower[2] + num_cells[2] * spacing};
    }
};

/// Whether a body fills a position.
using Region = std::function<bool(const Vector&)>;

/// Velocity in m/s at a position; none: at rest.
using VelocityField = std::function<Vector(const Vector&)>;

/// Material points on a lattice, at the centres of equal parts of the grid's cells.
struct Body {
    Region contains;
    std::array<int, 3> points_per_cell{2, 2, 2};
    std::string material;
    VelocityField velocity = {};  ///< at the start
    std::string name = {};        ///< for errors
    Box bounds = everywhere;      ///< around what it fills; open where that is not known
};

/// A model of a material by name, with its parameters; see material.hpp.
struct Material {
    std::string name;
    std::string model;
    Parameters parameters;
};

/// A side of the domain.
struct Wall {
    enum Kind {
        open,       ///< free; a point that passes it leaves the scene
        roller,     ///< no velocity across the wall
        fixed,      ///< no velocity
        frictional  ///< none into the wall, and Coulomb friction along it
    };

    Wall(Kind the_kind = open, double the_friction = 0) : kind(the_kind), friction(the_friction) {}

    Kind kind;
    double friction;  ///< coefficient of a frictional wall
};

struct Walls {
    Wall left = {}, right = {};  ///< across x
    Wall bottom = {}, top = {};  ///< across y
    Wall back = {}, front = {};  ///< across z
};

/// A plane through the domain, with solid ground behind it, that pushes and rubs points.
struct Plane {
    std::string name;
    Vector point{};       ///< on the plane, m
    Vector normal{};      ///< out of the ground, of any length
    double friction = 0;  ///< Coulomb's coefficient
};

/// An effect, with its parameters; see effect.hpp.
struct Effect {
    std::string name;
    Parameters parameters;
};

/// The point nearest to a position at the start, whose motion and stress are recorded.
struct Probe {
    std::string name;
    Vector position{};  ///< m
};

enum class ShapeFunction {
    linear,    ///< 2 nodes along an axis
    quadratic  ///< B-spline, 3 nodes
};

/// A scene in SI units.
///
/// An effect that is not named is not built. Two dimensions are plane strain, per metre of depth; y
/// points up.
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

/// An effect of a scene by name; null if the scene does not name it.
const Effect* find_effect(const Scene& scene, const std::string& name);

/// Checks a scene. Throws std::invalid_argument that names its fault.
void validate(const Scene& scene);

}  // namespace mpm
