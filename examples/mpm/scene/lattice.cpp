#include "scene/lattice.hpp"

#include "materials/material.hpp"
#include "materials/undrained.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace mpm {

Vector lattice_spacing(const Scene& scene, const Body& body) {
    Vector step{1, 1, 1};
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a)
        step[a] = scene.grid.spacing / body.points_per_cell[a];
    return step;
}

Vector raised(const Vector& at, const Vector& spacing, int dimension) {
    // Shares in a golden ratio: no side through two points of a lattice is along them.
    constexpr Vector shares{1e-6, 0.6180339887498949e-6, 0.3819660112501052e-6};
    Vector above = at;
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        above[a] += shares[a] * spacing[a];
    return above;
}

StartPlaces::StartPlaces(const Scene& scene)
    : dimension_(scene.dimension), lower_(scene.grid.lower) {
    std::int64_t next = 0;
    for (const Body& body : scene.bodies) {
        Lattice lattice{next, {1, 1, 1}, lattice_spacing(scene, body)};
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a)
            lattice.count[a] =
                std::int64_t{scene.grid.num_cells[a]} * std::int64_t{body.points_per_cell[a]};
        next += lattice.count[0] * lattice.count[1] * lattice.count[2];
        lattices_.push_back(lattice);
    }
}

Vector StartPlaces::place(const Lattice& lattice, const std::array<std::int64_t, 3>& node) const {
    Vector at{};
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a)
        at[a] = lower_[a] + (static_cast<double>(node[a]) + 0.5) * lattice.spacing[a];
    return at;
}

void StartPlaces::visit(const Body& body, const Lattice& lattice, const PointVisit& visit) const {
    constexpr double most_places = 1e10;
    double num_places = 1;
    std::array<std::int64_t, 3> first{}, end = lattice.count;
    // Only the part of the lattice that the bounds of the body touch is visited.
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension_); ++a) {
        const auto most = static_cast<double>(lattice.count[a]);
        const auto node = [&](double bound, double shift) {
            return static_cast<std::int64_t>(
                std::clamp((bound - lower_[a]) / lattice.spacing[a] + shift, 0.0, most));
        };
        first[a] = node(body.bounds.lower[a], -2);
        end[a] = node(body.bounds.upper[a], 2);
        num_places *= static_cast<double>(end[a] - first[a]);
    }
    if (num_places > most_places)
        throw std::invalid_argument("bodies / " + body.name +
                                    ": has more than 1e10 places for points; take larger cells or "
                                    "fewer points_per_cell");
    std::array<std::int64_t, 3> at;
    for (at[2] = first[2]; at[2] < end[2]; ++at[2])
        for (at[1] = first[1]; at[1] < end[1]; ++at[1])
            for (at[0] = first[0]; at[0] < end[0]; ++at[0]) {
                const Vector position = place(lattice, at);
                if (!body.contains(raised(position, lattice.spacing, dimension_))) continue;
                visit(body, position,
                      lattice.first_number + at[0] +
                          lattice.count[0] * (at[1] + lattice.count[1] * at[2]));
            }
}

std::size_t StartPlaces::body_of(double number) const {
    const auto after = std::ranges::upper_bound(lattices_, static_cast<std::int64_t>(number), {},
                                                &Lattice::first_number);
    return static_cast<std::size_t>(after - lattices_.begin()) - 1;
}

Vector StartPlaces::displacement(Positions at, std::span<const double> numbers,
                                 std::size_t point) const {
    const Lattice& lattice = lattices_[body_of(numbers[point])];
    const std::int64_t number = static_cast<std::int64_t>(numbers[point]) - lattice.first_number;
    const std::int64_t row = number / lattice.count[0];
    const Vector start =
        place(lattice, {number % lattice.count[0], row % lattice.count[1], row / lattice.count[1]});
    Vector way = at[point];
    for (std::size_t a = 0; a < 3; ++a) way[a] -= start[a];
    return way;
}

std::vector<Vector> StartPlaces::displacements(Positions at,
                                               std::span<const double> numbers) const {
    std::vector<Vector> all(numbers.size());
    for (std::size_t p = 0; p < all.size(); ++p) all[p] = displacement(at, numbers, p);
    return all;
}

double StartPlaces::front_x(Positions at, std::span<const double> numbers, double way) const {
    double front = -std::numeric_limits<double>::infinity();
    // Starts at the last point: if points are sorted, the last have the largest x and move first.
    for (std::size_t p = numbers.size(); p-- > 0;) {
        if (!(at.x[p] > front)) continue;
        double square = 0;
        for (const double component : displacement(at, numbers, p)) square += component * component;
        if (square > way * way) front = at.x[p];
    }
    return front;
}

void visit_points(const Scene& scene, const PointVisit& visit) {
    const StartPlaces places(scene);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        places.visit(scene.bodies[b], places.lattices_[b], visit);
}

void refuse_point(const std::string& place, const Vector& at, const std::string& text) {
    std::ostringstream all;
    all << place << " at x = " << at[0] << ", y = " << at[1] << ", z = " << at[2] << " m" << text;
    throw std::invalid_argument(all.str());
}

namespace {

/// Throws for a point whose velocity is not finite, that is also in a second body (its mass would
/// count twice), or that is behind a plane by more than half its size. All ranks check all points,
/// so that all of them throw.
void check_point(const Scene& scene, const Body& body, const Vector& at) {
    const std::string place = "bodies / " + body.name;
    if (body.velocity)
        for (const double component : body.velocity(at))
            if (!std::isfinite(component))
                refuse_point(place + ": the velocity", at, " must be finite");
    const Vector size = lattice_spacing(scene, body);
    const Vector above = raised(at, size, scene.dimension);
    for (const Body& other : scene.bodies)
        if (&other != &body && contains(other.bounds, above) && other.contains(above))
            refuse_point(place + ": overlaps the body '" + other.name + "'", at,
                         "; subtract the shape of one from the other");
    for (const Plane& plane : scene.planes) {
        double height = 0, half_size = 0;
        for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
            height += plane.normal[a] * (at[a] - plane.point[a]);
            half_size += 0.5 * std::abs(plane.normal[a]) * size[a];
        }
        if (height < -half_size)
            refuse_point("planes / " + plane.name + ": the body '" + body.name + "' lies behind it",
                         at, "; cut the body, or move or turn the plane");
    }
}

std::optional<Column> found(const Particles& particles, const char* name) {
    if (!particles.has_column(name)) return {};
    return particles.find_column(name);
}

}  // namespace

ScenePoints scene_points(const Scene& scene) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ScenePoints points{0, {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}};
    std::uint64_t hash = 14695981039346656037U;  // FNV-1a hash, of words instead of bytes
    std::vector<std::int64_t> of_body(scene.bodies.size());
    visit_points(scene, [&](const Body& body, const Vector& at, std::int64_t number) {
        check_point(scene, body, at);
        ++points.num_points;
        ++of_body[static_cast<std::size_t>(&body - scene.bodies.data())];
        hash = (hash ^ static_cast<std::uint64_t>(number)) * 1099511628211U;
        for (std::size_t a = 0; a < 3; ++a) {
            points.box.lower[a] = std::min(points.box.lower[a], at[a]);
            points.box.upper[a] = std::max(points.box.upper[a], at[a]);
        }
    });
    for (std::size_t b = 0; b < of_body.size(); ++b)
        if (of_body[b] == 0)
            throw std::invalid_argument("bodies / " + scene.bodies[b].name +
                                        ": holds no point; it must lie in the domain, and be no "
                                        "smaller than the distance of points in a cell");
    points.fingerprint = static_cast<double>(hash >> 11);
    return points;
}

NearestPoint nearest_point(const Scene& scene, const Vector& position) {
    NearestPoint nearest;
    double least = std::numeric_limits<double>::infinity();
    visit_points(scene, [&](const Body&, const Vector& at, std::int64_t number) {
        double square = 0;
        for (std::size_t a = 0; a < 3; ++a) square += (at[a] - position[a]) * (at[a] - position[a]);
        if (!(square < least)) return;
        least = square;
        nearest = {at, number};
    });
    return nearest;
}

void place_points(const Scene& scene, const Decomposition& decomposition, int rank,
                  const MotionColumns& motion, Particles& particles) {
    const std::optional<Column> material = found(particles, "material"),
                                start_level = found(particles, start_level_column);
    const auto dimension = static_cast<std::size_t>(scene.dimension);
    std::vector<double> densities;
    for (const Material& one : scene.materials)
        densities.push_back(density_of(one, scene.dimension));
    std::vector<double> row(particles.column_names().size());
    visit_points(scene, [&](const Body& body, const Vector& at, std::int64_t number) {
        int owner = 0;
        decomposition.owners({{&at[0], 1}, {&at[1], 1}, {&at[2], 1}}, {&owner, 1});
        if (owner != rank) return;
        const std::size_t made_of = material_of(scene, body);
        const Vector size = lattice_spacing(scene, body);
        const Vector velocity = body.velocity ? body.velocity(at) : Vector{};
        for (std::size_t a = 0; a < dimension; ++a) {
            row[motion.position[a]] = at[a];
            row[motion.velocity[a]] = velocity[a];
        }
        row[motion.volume] = size[0] * size[1] * size[2];
        row[motion.mass] = densities[made_of] * row[motion.volume];
        row[motion.id] = static_cast<double>(number);
        if (material) row[*material] = static_cast<double>(made_of);
        if (start_level) row[*start_level] = at[1];
        particles.append(row);
    });
}

}  // namespace mpm
