#include "effects/effect.hpp"
#include "effects/point_contact.hpp"
#include "effects/time_function.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace mpm {

namespace {

/// A rigid plane in motion.
template <int D>
struct MovingPlane {
    Components<D> normal;     ///< outward, of unit length
    double level;             ///< along the normal at the first time, m
    double friction;          ///< Coulomb's coefficient
    Components<D> direction;  ///< of the motion, of unit length
    TimeFunction speed;       ///< along it, m/s

    Components<D> velocity(double time) const {
        Components<D> velocity = direction;
        for (double& component : velocity) component *= speed.at(time);
        return velocity;
    }

    double level_at(double time) const {
        double along = 0;
        for (std::size_t a = 0; a < D; ++a) along += direction[a] * normal[a];
        return level + along * speed.integral(time);
    }
};

template <int D>
Components<D> unit(const std::vector<double>& numbers, const std::string& name) {
    Components<D> vector;
    std::copy_n(numbers.begin(), D, vector.begin());
    double square = 0;
    for (const double component : vector) square += component * component;
    if (!(square > 0 && std::isfinite(square)))
        throw std::invalid_argument("effects / moving_plane: '" + name + "' must not be zero");
    for (double& component : vector) component /= std::sqrt(square);
    return vector;
}

template <int D>
MovingPlane<D> read_plane(const Values& values) {
    const Components<D> normal = unit<D>(values.list("normal"), "normal");
    double level = 0;
    for (std::size_t a = 0; a < D; ++a) level += normal[a] * values.list("point")[a];
    return {normal, level, values.number("friction"),
            values.has("direction") ? unit<D>(values.list("direction"), "direction") : normal,
            TimeFunction(values.list("times"), values.list("speeds"), "effects / moving_plane")};
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
    double height = -plane.level_at(end);
    Components<D> relative;
    const Components<D> of_plane = plane.velocity(end);
    for (std::size_t a = 0; a < D; ++a) {
        height += particles[columns.motion.position[a]][p] * plane.normal[a];
        relative[a] = particles[columns.motion.velocity[a]][p] - of_plane[a];
    }
    // Most points are far away: a point is at most as large as a cell.
    if (height > 2 * columns.largest) {
        particles.data(columns.push)[p] = 0;
        return {};
    }
    const double width = std::pow(particles[columns.motion.volume][p], 1.0 / D);
    const Slip<D> slip = slip_of<D>(relative, plane.normal);
    const double contact_time = columns.times.contact(plane.speed.at(end), block.time_step);
    const double mass_rate = particles[columns.motion.mass][p] / contact_time;
    // The mean bears what presses the point against the plane; overlaps would have to, without it.
    double& mean = particles.data(columns.push)[p];
    const double push = std::max(
        0.0, mean + mass_rate * lost_speed<D>(slip, std::min(0.5 * width, columns.largest) - height,
                                              contact_time));
    mean += columns.times.weight(block.time_step) * (push - mean);
    return contact_force<D>(slip, plane.normal, push,
                            std::min(plane.friction * push, mass_rate * slip.speed));
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    Stages<D>& stages = builder.stages;
    const auto plane = std::make_shared<const MovingPlane<D>>(read_plane<D>(builder.values));
    PlaneColumns<D> columns{.motion = add_motion_columns(builder.particles, D),
                            .push = builder.particles.add_column("plane_push"),
                            .largest = 0.5 * builder.scene.grid.spacing,
                            .times = ContactTimes(builder)};
    const std::size_t first = stages.fields.size();
    for (std::size_t a = 0; a < D; ++a) {
        columns.force[a] = builder.particles.add_column(std::string("plane_force_") + "xyz"[a]);
        stages.fields.push_back({"moving_plane", columns.force[a], -1, static_cast<int>(a)});
    }
    stages.forces.push_back({"moving_plane", [=](GridPatch<D>& patch, const StepTime&) {
                                 for (std::size_t a = 0; a < D; ++a)
                                     for (std::size_t n = 0; n < patch.sums.size(); ++n)
                                         patch.sums[n].force[a] += patch.fields[first + a][n];
                             }});
    stages.after_materials.push_back(
        {"moving_plane", [=](Particles& particles, const PointBlock<D>& block) {
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
            build<3>};
}

}  // namespace mpm
