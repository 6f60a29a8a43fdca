#pragma once

#include <mpm/decomposition.hpp>
#include <mpm/particles.hpp>
#include <mpm/scene.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mpm {

/// Called with a body, the place and the number of a point.
using PointVisit = std::function<void(const Body&, const Vector&, std::int64_t)>;

/// The lattices of a scene's bodies. A point's number is its place on them, so that it tells where
/// the point was at the start.
class StartPlaces {
  public:
    explicit StartPlaces(const Scene& scene);

    /// Number of the body of the point with a number.
    std::size_t body_of(double number) const;

    /// How far the points with these numbers, now at these positions, have moved, m.
    std::vector<Vector> displacements(Positions at, std::span<const double> numbers) const;

    /// Largest x of those that have moved by more than `way` m; -infinity if there is none.
    double front_x(Positions at, std::span<const double> numbers, double way) const;

    friend void visit_points(const Scene& scene, const PointVisit& visit);

  private:
    struct Lattice {
        std::int64_t first_number;
        std::array<std::int64_t, 3> count;
        Vector spacing;
    };

    void visit(const Body& body, const Lattice& lattice, const PointVisit& visit) const;
    Vector place(const Lattice& lattice, const std::array<std::int64_t, 3>& node) const;
    Vector displacement(Positions at, std::span<const double> numbers, std::size_t point) const;

    int dimension_;
    Vector lower_;
    std::vector<Lattice> lattices_;
};

/// Number and extent of the points of a scene.
struct ScenePoints {
    std::int64_t num_points = 0;
    Box box;                 ///< empty without points
    double fingerprint = 0;  ///< of all numbers; other points rarely have the same
};

/// Points of a scene. Throws std::invalid_argument that names a body without points, or a
/// point whose velocity is not finite or that lies in two bodies or behind a plane.
ScenePoints scene_points(const Scene& scene);

/// Visits each point of a scene in ascending order of the numbers.
void visit_points(const Scene& scene, const PointVisit& visit);

/// Distance of a body's neighbouring points along the axes, m; in two dimensions 1 along z.
Vector lattice_spacing(const Scene& scene, const Body& body);

/// The point of a scene that is nearest to a position at the start, the first of equals.
struct NearestPoint {
    Vector place{};
    std::int64_t number = 0;
};
NearestPoint nearest_point(const Scene& scene, const Vector& position);

/// Throws std::invalid_argument: the place, a point of a body and the text of its fault.
[[noreturn]] void refuse_point(const std::string& place, const Vector& at, const std::string& text);

/// Appends the scene's points that `rank` owns. Columns other than those of motion, `material`
/// and the level at the start begin with 0.
void place_points(const Scene& scene, const Decomposition& decomposition, int rank,
                  const MotionColumns& motion, Particles& particles);

}  // namespace mpm
