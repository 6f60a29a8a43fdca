#pragma once

#include <mpm/decomposition.hpp>
#include <mpm/particles.hpp>
#include <mpm/scene.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mpm {

/// Function called with a body, and the position and number of a point.
using PointVisit = std::function<void(const Body&, const Vector&, std::int64_t)>;

/// Computes the start positions of points from their numbers. A point's number is its index on the
/// lattices of the scene's bodies.
class StartPlaces {
  public:
    explicit StartPlaces(const Scene& scene);

    /// Returns the index of the body that contains the point with this number.
    std::size_t body_of(double number) const;

    /// Returns the displacements of the points with these numbers, which are now at these
    /// positions, m.
    std::vector<Vector> displacements(Positions at, std::span<const double> numbers) const;

    /// Returns the largest x of the points that have moved by more than `way` m, or -infinity if
    /// none has.
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

/// Returns a place a millionth of the spacing of points above another. A body takes a point if it
/// contains the raised place. So bodies are half-open, however points on their sides are rounded.
Vector raised(const Vector& at, const Vector& spacing, int dimension);

/// The number and the extent of the points of a scene.
struct ScenePoints {
    std::int64_t num_points = 0;
    Box box;                 ///< empty if there are no points
    double fingerprint = 0;  ///< hash of all numbers; two different scenes rarely have the same
};

/// Counts the points of a scene. Throws std::invalid_argument that names the fault: a body without
/// points, a point whose velocity is not finite, or one in two bodies or behind a plane.
ScenePoints scene_points(const Scene& scene);

/// Visits the points of a scene in ascending order of their numbers.
void visit_points(const Scene& scene, const PointVisit& visit);

/// Returns the distance between neighbouring points of a body along each axis, m; 1 along z in two
/// dimensions.
Vector lattice_spacing(const Scene& scene, const Body& body);

/// The point of a scene that is nearest to a position at the start, or the first if several are.
struct NearestPoint {
    Vector place{};
    std::int64_t number = 0;
};
NearestPoint nearest_point(const Scene& scene, const Vector& position);

/// Throws std::invalid_argument with the place in the scene, the position of the point and `text`.
[[noreturn]] void refuse_point(const std::string& place, const Vector& at, const std::string& text);

/// Appends the scene's points that `rank` owns. Sets the columns of motion, `material` and the
/// level at the start. All other columns are 0.
void place_points(const Scene& scene, const Decomposition& decomposition, int rank,
                  const MotionColumns& motion, Particles& particles);

}  // namespace mpm
