#include "scene/lattice.hpp"

#include "materials/material.hpp"
#include "materials/undrained.hpp"

#include <algorithm>
#include <bit>
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

namespace {

std::array<int, 3> num_points_along(const Scene& scene, const Body& body) {
    std::array<int, 3> count{1, 1, 1};
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a)
        count[a] = scene.grid.num_cells[a] * body.points_per_cell[a];
    return count;
}

/// Calls visit(place, its number in the row along x) for each point in the order of their numbers.
template <typename Visit>
void visit_body(const Scene& scene, const Body& body, Visit visit) {
    const Vector step = lattice_spacing(scene, body);
    const std::array<int, 3> count = num_points_along(scene, body);
    for (int k = 0; k < count[2]; ++k)
        for (int j = 0; j < count[1]; ++j)
            for (int i = 0; i < count[0]; ++i) {
                Vector at{scene.grid.lower[0] + (i + 0.5) * step[0],
                          scene.grid.lower[1] + (j + 0.5) * step[1], 0};
                if (scene.dimension == 3) at[2] = scene.grid.lower[2] + (k + 0.5) * step[2];
                if (body.contains(at)) visit(at, i);
            }
}

/// Distance of the positions whose velocities tell the gradient at the start, m.
double difference_step(const Scene& scene) {
    return 0.25 * scene.grid.spacing;
}

/// Positions below and above a point along an axis.
std::pair<Vector, Vector> around(const Scene& scene, const Vector& at, std::size_t axis) {
    std::pair<Vector, Vector> below_and_above{at, at};
    below_and_above.first[axis] -= 0.5 * difference_step(scene);
    below_and_above.second[axis] += 0.5 * difference_step(scene);
    return below_and_above;
}

void require_finite(const Body& body, const Vector& at) {
    for (const double component : body.velocity(at)) {
        if (std::isfinite(component)) continue;
        std::ostringstream text;
        text << "bodies / " << body.name << ": the velocity at x = " << at[0] << ", y = " << at[1]
             << ", z = " << at[2] << " m must be finite";
        throw std::invalid_argument(text.str());
    }
}

/// Checks the velocities of a body that place_points will ask for. All ranks check all points, so
/// that they fail together.
void check_velocity(const Scene& scene, const Body& body, const Vector& at) {
    if (!body.velocity) return;
    require_finite(body, at);
    if (scene.transfer != Transfer::apic) return;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
        const auto [below, above] = around(scene, at, a);
        require_finite(body, below);
        require_finite(body, above);
    }
}

/// Refuses a point of a body that lies in another one, too: its mass would be there twice.
void check_alone(const Scene& scene, const Body& body, const Vector& at) {
    for (const Body& other : scene.bodies) {
        if (&other == &body || !contains(other.bounds, at) || !other.contains(at)) continue;
        std::ostringstream text;
        text << "bodies / " << body.name << ": overlaps the body '" << other.name
             << "' at x = " << at[0] << ", y = " << at[1] << ", z = " << at[2]
             << " m; subtract the shape of one from the other";
        throw std::invalid_argument(text.str());
    }
}

std::optional<Column> found(const Particles& particles, const char* name) {
    if (!particles.has_column(name)) return {};
    return particles.find_column(name);
}

/// Writes one point of a body into a row of columns.
class RowWriter {
  public:
    RowWriter(const Scene& scene, const MotionColumns& motion, const Particles& particles)
        : scene_(scene),
          motion_(motion),
          row_(particles.initial_row()),
          material_(found(particles, "material")),
          start_level_(found(particles, start_level_column)) {
        for (std::size_t a = 0; a < num_axes(); ++a)
            for (std::size_t b = 0; b < num_axes(); ++b) {
                const std::string name = std::string("affine_") + "xyz"[a] + "xyz"[b];
                if (particles.has_column(name)) affine_.push_back(particles.find_column(name));
            }
    }

    std::span<const double> write(const Body& body, const Vector& at, std::int64_t id) {
        const Vector velocity = body.velocity ? body.velocity(at) : Vector{};
        for (std::size_t a = 0; a < num_axes(); ++a) {
            row_[motion_.position[a]] = at[a];
            row_[motion_.velocity[a]] = velocity[a];
        }
        write_affine(body, at);
        row_[motion_.volume] = volume_;
        row_[motion_.mass] = mass_;
        row_[motion_.id] = static_cast<double>(id);
        if (start_level_) row_[*start_level_] = at[1];
        return row_;
    }

    void start(const Body& body) {
        const std::size_t number = material_of(scene_, body);
        const Vector step = lattice_spacing(scene_, body);
        volume_ = step[0] * step[1] * step[2];
        mass_ = values_of(scene_.materials[number], scene_.dimension).number("density") * volume_;
        if (material_) row_[*material_] = static_cast<double>(number);
    }

  private:
    std::size_t num_axes() const { return static_cast<std::size_t>(scene_.dimension); }

    /// Writes the gradient of the velocity at the start, by differences.
    void write_affine(const Body& body, const Vector& at) {
        if (affine_.empty() || !body.velocity) return;
        const double step = difference_step(scene_);
        for (std::size_t b = 0; b < num_axes(); ++b) {
            const auto [below, above] = around(scene_, at, b);
            const Vector high = body.velocity(above), low = body.velocity(below);
            for (std::size_t a = 0; a < num_axes(); ++a)
                row_[affine_[a * num_axes() + b]] = (high[a] - low[a]) / step;
        }
    }

    const Scene& scene_;
    const MotionColumns& motion_;
    std::vector<Column> affine_;  ///< of APIC
    std::vector<double> row_;
    std::optional<Column> material_, start_level_;
    double volume_ = 0, mass_ = 0;
};

}  // namespace

void StartPlaces::append(const Vector& at, int i, double spacing) {
    const bool goes_on = !rows_.empty() && rows_.back().spacing == spacing &&
                         rows_.back().first_i + (size_ - rows_.back().first_number) == i &&
                         rows_.back().y == at[1] && rows_.back().z == at[2];
    if (!goes_on) rows_.push_back({size_, i, at[1], at[2], spacing});
    ++size_;
}

/// Looks displacements up. It keeps the row at hand: neighbours often share one.
class StartPlaces::Reader {
  public:
    Reader(const StartPlaces& places, Positions at, std::span<const double> numbers)
        : places_(places), at_(at), numbers_(numbers) {}

    Vector displacement(std::size_t p) {
        const auto number = static_cast<std::int64_t>(numbers_[p]);
        if (number < row_.first_number || number >= end_) find_row(number);
        const auto i = static_cast<double>(row_.first_i + (number - row_.first_number));
        const double start_x = places_.lower_x_ + (i + 0.5) * row_.spacing;
        return {at_.x[p] - start_x, at_.y[p] - row_.y, at_.z.empty() ? 0 : at_.z[p] - row_.z};
    }

  private:
    void find_row(std::int64_t number) {
        const auto next = std::ranges::upper_bound(places_.rows_, number, {}, &Row::first_number);
        row_ = *(next - 1);
        end_ = next == places_.rows_.end() ? places_.size_ : next->first_number;
    }

    const StartPlaces& places_;
    Positions at_;
    std::span<const double> numbers_;
    Row row_{};
    std::int64_t end_ = 0;  ///< of the numbers of the row
};

std::vector<Vector> StartPlaces::displacements(Positions at,
                                               std::span<const double> numbers) const {
    Reader reader(*this, at, numbers);
    std::vector<Vector> all(numbers.size());
    for (std::size_t p = 0; p < all.size(); ++p) all[p] = reader.displacement(p);
    return all;
}

double StartPlaces::front_x(Positions at, std::span<const double> numbers, double way) const {
    Reader reader(*this, at, numbers);
    double front = -std::numeric_limits<double>::infinity();
    // From the last on: sorted, they are the highest, which move first.
    for (std::size_t p = numbers.size(); p-- > 0;) {
        if (!(at.x[p] > front)) continue;
        double square = 0;
        for (const double component : reader.displacement(p)) square += component * component;
        if (square > way * way) front = at.x[p];
    }
    return front;
}

double StartPlaces::fingerprint() const {
    std::uint64_t hash = 14695981039346656037U;  // FNV-1a, by words in place of bytes
    for (const Row& row : rows_)
        for (const double part : {static_cast<double>(row.first_number),
                                  static_cast<double>(row.first_i), row.y, row.z, row.spacing})
            hash = (hash ^ std::bit_cast<std::uint64_t>(part)) * 1099511628211U;
    return static_cast<double>(hash >> 11);
}

ScenePoints scene_points(const Scene& scene) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ScenePoints points{0,
                       {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}},
                       StartPlaces(scene.grid.lower[0])};
    for (const Body& body : scene.bodies) {
        const std::int64_t num_before = points.num_points;
        const double spacing = lattice_spacing(scene, body)[0];
        visit_body(scene, body, [&](const Vector& at, int i) {
            check_velocity(scene, body, at);
            check_alone(scene, body, at);
            points.start_places.append(at, i, spacing);
            ++points.num_points;
            for (std::size_t a = 0; a < 3; ++a) {
                points.box.lower[a] = std::min(points.box.lower[a], at[a]);
                points.box.upper[a] = std::max(points.box.upper[a], at[a]);
            }
        });
        if (points.num_points == num_before)
            throw std::invalid_argument("bodies / " + body.name +
                                        ": holds no point; it must lie in the domain, and be no "
                                        "smaller than the distance of points in a cell");
    }
    for (const Plane& plane : scene.planes) check_in_front(scene, plane, "planes / " + plane.name);
    return points;
}

void visit_points(const Scene& scene,
                  const std::function<void(const Body&, const Vector&)>& visit) {
    for (const Body& body : scene.bodies)
        visit_body(scene, body, [&](const Vector& at, int) { visit(body, at); });
}

void check_in_front(const Scene& scene, const Plane& plane, const std::string& place) {
    visit_points(scene, [&](const Body& body, const Vector& at) {
        const Vector size = lattice_spacing(scene, body);
        double height = 0, half_size = 0, square = 0;
        for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
            height += plane.normal[a] * (at[a] - plane.point[a]);
            half_size += 0.5 * std::abs(plane.normal[a]) * size[a];
            square += plane.normal[a] * plane.normal[a];
        }
        if (!(height < -half_size)) return;
        std::ostringstream text;
        text << place << ": the body '" << body.name << "' lies behind it by "
             << -height / std::sqrt(square) << " m at x = " << at[0] << ", y = " << at[1]
             << ", z = " << at[2] << " m; cut the body, or move or turn the plane";
        throw std::invalid_argument(text.str());
    });
}

std::vector<BodyPoints> points_of_bodies(const Scene& scene) {
    std::vector<BodyPoints> all;
    for (const Body& body : scene.bodies) {
        BodyPoints& points = all.emplace_back();
        visit_body(scene, body, [&](const Vector&, int) { ++points.num_points; });
        points.spacing = lattice_spacing(scene, body);
        for (const double along : points.spacing) points.volume *= along;
        points.volume *= static_cast<double>(points.num_points);
    }
    return all;
}

Vector nearest_point(const Scene& scene, const Vector& position) {
    Vector nearest{};
    double least = std::numeric_limits<double>::infinity();
    for (const Body& body : scene.bodies)
        visit_body(scene, body, [&](const Vector& at, int) {
            double square = 0;
            for (std::size_t a = 0; a < 3; ++a)
                square += (at[a] - position[a]) * (at[a] - position[a]);
            if (!(square < least)) return;
            least = square;
            nearest = at;
        });
    return nearest;
}

void place_points(const Scene& scene, const Decomposition& decomposition, int rank,
                  const MotionColumns& motion, Particles& particles) {
    RowWriter writer(scene, motion, particles);
    std::int64_t id = 0;
    for (const Body& body : scene.bodies) {
        writer.start(body);
        visit_body(scene, body, [&](const Vector& at, int) {
            int owner = 0;
            decomposition.owners({{&at[0], 1}, {&at[1], 1}, {&at[2], 1}}, {&owner, 1});
            if (owner == rank) particles.append(writer.write(body, at, id));
            ++id;
        });
    }
}

}  // namespace mpm
