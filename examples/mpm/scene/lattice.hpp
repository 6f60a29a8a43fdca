#pragma once

#include <mpm/decomposition.hpp>
#include <mpm/particles.hpp>
#include <mpm/scene.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mpm {

/// Where the points of a scene were at the start, by their numbers: rows of the lattice along x.
class StartPlaces {
  public:
    explicit StartPlaces(double lower_x) : lower_x_(lower_x) {}

    /// Adds the next point: its place, and its number and the distance of neighbours in its row.
    void append(const Vector& at, int i, double spacing);

    /// How far the points with these numbers, now at these positions, have moved, m.
    std::vector<Vector> displacements(Positions at, std::span<const double> numbers) const;

    /// Largest x of those that have moved by more than `way` m; -infinity where there is none.
    double front_x(Positions at, std::span<const double> numbers, double way) const;

    /// A number that others rarely have, the same on all ranks.
    double fingerprint() const;

  private:
    class Reader;
    struct Row {
        std::int64_t first_number, first_i;
        double y, z, spacing;
    };

    double lower_x_;
    std::vector<Row> rows_;
    std::int64_t size_ = 0;
};

/// Number and place of the points of a scene.
struct ScenePoints {
    std::int64_t num_points = 0;
    Box box;  ///< empty without points
    StartPlaces start_places;
};

/// Points of a scene. Throws std::invalid_argument that names a body without points, or a
/// point whose velocity is not finite or that lies in two bodies or behind a plane.
ScenePoints scene_points(const Scene& scene);

/// Calls visit(body, place) for each point of a scene in the order of their numbers.
void visit_points(const Scene& scene, const std::function<void(const Body&, const Vector&)>& visit);

/// Throws std::invalid_argument that names a point of a scene that lies behind a plane by more than
/// half its size. `place` is for the error.
void check_in_front(const Scene& scene, const Plane& plane, const std::string& place);

/// The points of one body on the lattice.
struct BodyPoints {
    std::int64_t num_points = 0;
    double volume = 1;  ///< of all, m^3; in two dimensions per metre of depth
    Vector spacing{};   ///< distance of neighbours along the axes, m
};

/// The points of each body of a scene, in their order.
std::vector<BodyPoints> points_of_bodies(const Scene& scene);

/// Distance of a body's neighbouring points along the axes, m; in two dimensions 1 along z.
Vector lattice_spacing(const Scene& scene, const Body& body);

/// The place of the point of a scene that is nearest to a position, the first of equals.
Vector nearest_point(const Scene& scene, const Vector& position);

/// Appends the scene's points that `rank` owns. Columns other than those of motion, `material`
/// and the level at the start begin with their initial values.
void place_points(const Scene& scene, const Decomposition& decomposition, int rank,
                  const MotionColumns& motion, Particles& particles);

}  // namespace mpm
