#include "effects/effect.hpp"
#include "effects/moving_ground.hpp"
#include "effects/point_contact.hpp"
#include "scene/lattice.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace mpm {

namespace {

/// A rigid plane in motion.
template <int D>
struct MovingPlane {
    Ground<D> ground;
    double friction;  ///< Coulomb's coefficient
};

Vector direction_of(const Values& values, const std::string& name, const std::string& place) {
    Vector vector{};
    std::ranges::copy(values.list(name), vector.begin());
    const double square = vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2];
    if (!(square > 0 && std::isfinite(square)))
        throw std::invalid_argument(place + ": '" + name + "' must not be zero");
    return vector;
}

template <int D>
MovingPlane<D> read_plane(const Scene& scene, const Values& values, const std::string& place) {
    Plane plane{.name = place, .normal = direction_of(values, "normal", place)};
    std::ranges::copy(values.list("point"), plane.point.begin());
    plane.wall.motion = {
        values.has("direction") ? direction_of(values, "direction", place) : plane.normal,
        values.list("times"), values.list("speeds")};
    check_in_front(scene, plane, place);
    return {Ground<D>(plane), values.number("friction")};
}

template <int D>
struct PlaneColumns {
    MotionColumns motion;
    std::array<Column, D> force{};
    Column push = 0;     ///< mean of the last steps, N
    double largest = 0;  ///< half the width of a point, m
    ContactTimes times;
};

/// Force of the next step on a point by the plane, where it will be by the end of that step.
template <int D>
Components<D> force_on(const MovingPlane<D>& plane, const PlaneColumns<D>& columns,
                       Particles& particles, std::size_t p, const PointBlock<D>& block) {
    const double end = block.time + 2 * block.time_step;
    Components<D> at, relative;
    const Components<D> of_plane = plane.ground.velocity(end);
    for (std::size_t a = 0; a < D; ++a) {
        at[a] = particles[columns.motion.position[a]][p];
        relative[a] = particles[columns.motion.velocity[a]][p] - of_plane[a];
    }
    const Components<D>& normal = plane.ground.normal;
    const double height = plane.ground.height(plane.ground.origin(at, end));
    // Most points are far away: a point is at most as large as a cell.
    if (height > 2 * columns.largest) {
        particles.data(columns.push)[p] = 0;
        return {};
    }
    const double width = std::pow(particles[columns.motion.volume][p], 1.0 / D);
    const Slip<D> slip = slip_of<D>(relative, normal);
    const double contact_time =
        columns.times.contact(std::sqrt(along_normal<D>(of_plane, of_plane)), block.time_step);
    const double mass_rate = particles[columns.motion.mass][p] / contact_time;
    // The mean bears what presses the point against the plane; overlaps would have to, without it.
    double& mean = particles.data(columns.push)[p];
    const double push = std::max(
        0.0, mean + mass_rate * lost_speed<D>(slip, std::min(0.5 * width, columns.largest) - height,
                                              contact_time));
    mean += columns.times.weight(block.time_step) * (push - mean);
    return contact_force<D>(slip, normal, push,
                            std::min(plane.friction * push, mass_rate * slip.speed));
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    Stages<D>& stages = builder.stages;
    const auto plane = std::make_shared<const MovingPlane<D>>(
        read_plane<D>(builder.scene, builder.values, "effects / " + builder.name));
    PlaneColumns<D> columns{.motion = add_motion_columns(builder.particles, D),
                            .push = builder.add_own_column("_push"),
                            .largest = 0.5 * builder.scene.grid.spacing,
                            .times = ContactTimes(builder)};
    const std::size_t first = stages.fields.size();
    for (std::size_t a = 0; a < D; ++a) {
        columns.force[a] = builder.add_own_column(std::string("_force_") + "xyz"[a]);
        stages.fields.push_back({builder.name, columns.force[a], -1, static_cast<int>(a)});
    }
    stages.forces.push_back({builder.name, [=](GridPatch<D>& patch, const StepTime&) {
                                 for (std::size_t a = 0; a < D; ++a)
                                     for (std::size_t n = 0; n < patch.sums.size(); ++n)
                                         patch.sums[n].force[a] += patch.fields[first + a][n];
                             }});
    stages.after_materials.push_back(
        {builder.name, [=](Particles& particles, const PointBlock<D>& block) {
             for (std::size_t p = block.begin; p < block.end; ++p) {
                 const Components<D> force = force_on<D>(*plane, columns, particles, p, block);
                 for (std::size_t a = 0; a < D; ++a) particles.data(columns.force[a])[p] = force[a];
             }
         }});
}

}  // namespace

/// A rigid plane that moves at a speed that is a function of time, as a piston or a shaken base.
///
/// It pushes the points that it touches, and rubs them by Coulomb's law; nothing holds them at it.
/// The volume of a point tells its width.
EffectKind moving_plane_effect() {
    return {"moving_plane",
            {vector("point", "m"), vector("normal", ""), optional(vector("direction", "")),
             not_negative("friction", "", 0.0), numbers("times", "s", std::vector<double>{0}),
             numbers("speeds", "m/s")},
            build<2>,
            build<3>,
            true};
}

}  // namespace mpm
