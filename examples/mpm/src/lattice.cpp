#include <mpm/lattice.hpp>

#include <algorithm>
#include <limits>

namespace mpm {

namespace {

Vector lattice_spacing(const Scene& scene, const Body& body) {
    return {scene.grid.spacing / body.points_per_cell[0],
            scene.grid.spacing / body.points_per_cell[1]};
}

template <typename Visit>
void visit_lattice(const Scene& scene, Visit visit) {
    std::int64_t id = 0;
    for (const Body& body : scene.bodies) {
        const Vector step = lattice_spacing(scene, body);
        for (int j = 0; j < scene.grid.num_cells[1] * body.points_per_cell[1]; ++j)
            for (int i = 0; i < scene.grid.num_cells[0] * body.points_per_cell[0]; ++i) {
                const double x = scene.grid.lower[0] + (i + 0.5) * step[0];
                const double y = scene.grid.lower[1] + (j + 0.5) * step[1];
                if (body.contains(x, y)) visit(body, Vector{x, y}, id++);
            }
    }
}

}  // namespace

Extent extent_of(const Scene& scene) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Extent extent{0, {{infinity, infinity}, {-infinity, -infinity}}};
    visit_lattice(scene, [&](const Body&, const Vector& at, std::int64_t) {
        ++extent.num_points;
        for (std::size_t a = 0; a < 2; ++a) {
            extent.box.lower[a] = std::min(extent.box.lower[a], at[a]);
            extent.box.upper[a] = std::max(extent.box.upper[a], at[a]);
        }
    });
    return extent;
}

void place_points(const Scene& scene, const Decomposition& decomposition, int rank,
                  const MotionColumns& motion, Particles& particles) {
    std::vector<double> row(particles.column_names().size());
    visit_lattice(scene, [&](const Body& body, const Vector& at, std::int64_t id) {
        int owner = 0;
        decomposition.owners({{&at[0], 1}, {&at[1], 1}}, {&owner, 1});
        if (owner != rank) return;
        const Vector step = lattice_spacing(scene, body);
        const Vector velocity = body.velocity ? body.velocity(at[0], at[1]) : Vector{};
        row[motion.x] = at[0];
        row[motion.y] = at[1];
        row[motion.velocity_x] = velocity[0];
        row[motion.velocity_y] = velocity[1];
        row[motion.volume] = step[0] * step[1];
        row[motion.mass] = body.density * row[motion.volume];
        row[motion.id] = static_cast<double>(id);
        particles.append(row);
    });
}

}  // namespace mpm
