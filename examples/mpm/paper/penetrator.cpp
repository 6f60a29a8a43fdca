#include "paper/penetrator.hpp"

#include "effects/effect.hpp"
#include "materials/material.hpp"
#include "materials/undrained.hpp"
#include "scene/lattice.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

namespace mpm {

namespace {

/// A rigid body in contact with points, and the contact force.
template <int D>
struct RigidContact {
    Penetrator<D> body;
    double friction = 0;                         ///< Coulomb's coefficient
    std::optional<FrictionBands<D>> bands = {};  ///< present if friction has a limit
    double force = 0;       ///< force along y on the points of all ranks in this step, N
    double last_force = 0;  ///< the same in the previous step, N
    double next_force = 0;  ///< force along y on this rank's points in the next step, N
};

/// Computes the undrained strength of points of any material.
template <int D>
class SoilStrength {
  public:
    explicit SoilStrength(const EffectBuilder<D>& builder)
        : start_level_(builder.particles.add_column(start_level_column)) {
        for (const Material& material : builder.scene.materials) {
            if (material.model != "von_mises")
                throw std::invalid_argument(
                    "effects / penetrator: 'adhesion_factor' needs an undrained strength; the "
                    "material '" +
                    material.name + "' must be von_mises, not " + material.model);
            clays_.push_back(undrained_of(values_of(material, D)));
        }
        if (clays_.size() > 1) material_ = builder.particles.find_column("material");
        if (builder.particles.has_column("plastic_strain"))
            plastic_strain_ = builder.particles.find_column("plastic_strain");
    }

    /// Returns the strength of point `p` at its depth and softening, Pa.
    double at(const Particles& particles, std::size_t p) const {
        const double number = material_ ? particles[*material_][p] : 0;
        const UndrainedStrength& clay = clays_[static_cast<std::size_t>(number)];
        double strength = clay.intact(particles[start_level_][p]);
        if (plastic_strain_) strength *= clay.softened(particles[*plastic_strain_][p]);
        return strength;
    }

  private:
    std::vector<UndrainedStrength> clays_;  ///< by material
    Column start_level_;
    std::optional<Column> material_, plastic_strain_;
};

/// Constant parameters of the contact.
template <int D>
struct Settings {
    MotionColumns motion;
    std::array<Column, D> force{};
    double spacing, wave_speed;
    double adhesion_factor = 0;
    std::optional<SoilStrength<D>> strength = {};

    /// Returns the time in which contact stops a point relative to a body of this speed, s. It is
    /// the step for a Courant number of 0.3, or the actual step if that is longer.
    double contact_time(double speed, double time_step) const {
        return std::max(0.3 * spacing / (wave_speed + std::abs(speed)), time_step);
    }
};

/// Computes the contact forces of one step on the points of a block.
template <int D>
class Pusher {
  public:
    Pusher(RigidContact<D>& contact, const Settings<D>& settings, const Particles& particles,
           const PointBlock<D>& block)
        : contact_(contact), settings_(settings), particles_(particles), body_(contact.body) {
        // The force acts in the next step, when the body has moved on.
        body_.tip[1] += block.time_step * body_.velocity;
        time_ = settings.contact_time(body_.velocity, block.time_step);
        ahead_ = time_ * std::abs(body_.velocity);
    }

    std::optional<Components<D>> force_on(std::size_t p) const {
        Vector at{};
        for (std::size_t a = 0; a < D; ++a) at[a] = particles_[settings_.motion.position[a]][p];
        // No point is larger than a cell, so most points are too far away.
        const double largest = 0.5 * settings_.spacing;
        if (!body_.touch(at, largest + ahead_)) return std::nullopt;
        const double width = std::pow(particles_[settings_.motion.volume][p], 1.0 / D);
        const auto touch = body_.touch(at, std::min(0.5 * width, largest) + ahead_);
        if (!touch) return std::nullopt;
        return force_of(*touch, p, at[1] - body_.tip[1]);
    }

  private:
    Components<D> force_of(const Touch<D>& touch, std::size_t p, double height) const {
        const Components<D>& normal = touch.normal;
        Components<D> along;  // tangential part of the velocity relative to the body
        for (std::size_t a = 0; a < D; ++a) along[a] = particles_[settings_.motion.velocity[a]][p];
        along[1] -= body_.velocity;
        double inward = 0, square = 0;
        for (std::size_t a = 0; a < D; ++a) inward -= along[a] * normal[a];
        for (std::size_t a = 0; a < D; ++a) {
            along[a] += inward * normal[a];
            square += along[a] * along[a];
        }
        const double speed = std::sqrt(square), overlap = touch.depth - ahead_;
        // A point may close a gap within the contact time. Of an overlap only half is removed.
        const double recovered = overlap < 0 ? overlap : 0.5 * overlap;
        const double mass_rate = particles_[settings_.motion.mass][p] / time_;
        const double push = mass_rate * std::max(0.0, inward + recovered / time_);
        const double friction = std::min(friction_on(p, height, push), mass_rate * speed);
        Components<D> force;
        for (std::size_t a = 0; a < D; ++a) {
            force[a] = push * normal[a];
            if (speed > 0) force[a] -= friction * along[a] / speed;
        }
        return force;
    }

    double friction_on(std::size_t p, double height, double push) const {
        if (!contact_.bands) return contact_.friction * push;
        contact_.bands->add(height, push,
                            settings_.adhesion_factor * settings_.strength->at(particles_, p));
        return contact_.bands->most_at(height, contact_.friction) * push;
    }

    RigidContact<D>& contact_;
    const Settings<D>& settings_;
    const Particles& particles_;
    Penetrator<D> body_;
    double time_ = 0;   ///< contact time, s
    double ahead_ = 0;  ///< distance that the body moves in it, m
};

/// Adds the kernels that push points out of the body.
///
/// The width of a point follows from its volume. Within a contact time a point loses its velocity
/// into the body and half of its overlap. Contact never pulls a point towards the body.
template <int D>
void add_contact(const EffectBuilder<D>& builder, const std::shared_ptr<RigidContact<D>>& contact) {
    Stages<D>& stages = builder.stages;
    Settings<D> settings{.motion = add_motion_columns(builder.particles, D),
                         .spacing = builder.scene.grid.spacing,
                         .wave_speed = builder.wave_speed};
    if (builder.values.has("adhesion_factor")) {
        settings.adhesion_factor = builder.values.number("adhesion_factor");
        settings.strength.emplace(builder);
        contact->bands.emplace(contact->body, settings.spacing,
                               contact->body.share_in(builder.scene.grid));
    }
    const std::size_t first = stages.fields.size();
    for (std::size_t a = 0; a < D; ++a) {
        settings.force[a] = builder.particles.add_column(std::string("contact_force_") + "xyz"[a]);
        stages.fields.push_back({"contact", settings.force[a], static_cast<int>(a)});
    }
    stages.forces.push_back({"contact", [=](GridPatch<D>& patch, const StepTime&) {
                                 for (std::size_t a = 0; a < D; ++a)
                                     for (std::size_t n = 0; n < patch.sums.size(); ++n)
                                         patch.sums[n].force[a] += patch.fields[first + a][n];
                             }});
    stages.after_materials.push_back(
        {"contact", [=](Particles& particles, const PointBlock<D>& block) {
             const Pusher<D> pusher(*contact, settings, particles, block);
             for (std::size_t p = block.begin; p < block.end; ++p) {
                 const auto force = pusher.force_on(p);
                 for (std::size_t a = 0; a < D; ++a)
                     particles.data(settings.force[a])[p] = force ? (*force)[a] : 0;
                 if (force) contact->next_force += (*force)[1];
             }
         }});
}

/// Loads on the body other than those of the soil.
template <int D>
struct Loads {
    Gravity<D> gravity;
    double heavy_mass = 0;   ///< mass that has weight, less the fluid displaced, kg
    double drag_factor = 0;  ///< drag by the square of the speed, kg/m
};

/// Sums the contact forces over the ranks, moves the body by its equation of motion and begins the
/// next step. Collective: one reduction.
template <int D>
void move_body(RigidContact<D>& contact, const Loads<D>& loads, const StepTime& step,
               double weight_of_step, MPI_Comm comm) {
    std::vector<double> sums{std::exchange(contact.next_force, 0)};
    if (contact.bands)
        sums.insert(sums.end(), contact.bands->sums().begin(), contact.bands->sums().end());
    const auto count = static_cast<int>(sums.size());
    std::vector<double> totals(sums.size());
    MPI_Reduce(sums.data(), totals.data(), count, MPI_DOUBLE, MPI_SUM, 0, comm);
    MPI_Bcast(totals.data(), count, MPI_DOUBLE, 0, comm);
    if (contact.bands) contact.bands->settle(std::span(totals).subspan(1), weight_of_step);
    Penetrator<D>& body = contact.body;
    const double weight =
        loads.heavy_mass * loads.gravity.acceleration[1] * loads.gravity.share_at(step.time);
    // Drag is implicit in the speed, so it cannot reverse the motion of the body.
    const double rate = loads.drag_factor * std::abs(body.velocity);
    const double drag = -rate * body.velocity / (1 + step.time_step * rate / body.mass);
    body.velocity += step.time_step * (weight + drag - contact.force) / body.mass;
    body.tip[1] += step.time_step * body.velocity;
    contact.last_force = std::exchange(contact.force, totals.front());
}

template <int D>
Penetrator<D> read_body(const Values& values) {
    Penetrator<D> body{.radius = values.number("radius"),
                       .cone_height = values.number("cone_height"),
                       .length = values.number("length"),
                       .mass = values.number("mass"),
                       .velocity = values.number("velocity")};
    std::copy_n(values.list("tip").begin(), D, body.tip.begin());
    if (body.cone_height > body.length)
        throw std::invalid_argument(
            "effects / penetrator: 'cone_height' must be at most the length");
    return body;
}

/// Throws std::invalid_argument for a point that starts inside the body by more than half its size:
/// contact would eject it at high speed. All ranks check all points.
template <int D>
void check_apart(const Penetrator<D>& body, const Scene& scene) {
    visit_points(scene, [&](const Body& soil, const Vector& at, std::int64_t) {
        const Vector size = lattice_spacing(scene, soil);
        const auto touch = body.touch(at, 0);
        if (touch && touch->depth > 0.5 * *std::max_element(size.begin(), size.begin() + D))
            refuse_point("effects / penetrator: the body '" + soil.name + "' begins in it", at,
                         "; subtract its shape from the body, or place its 'tip' elsewhere");
    });
}

template <int D>
Loads<D> read_loads(const EffectBuilder<D>& builder, const Penetrator<D>& body) {
    const Values& values = builder.values;
    const double fluid = values.number("fluid_density") * body.share_in(builder.scene.grid);
    return {.gravity = builder.stages.gravity.value_or(Gravity<D>{}),
            .heavy_mass = body.mass - fluid * body.volume(),
            .drag_factor = 0.5 * fluid * values.number("drag_coefficient") * body.section()};
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    Stages<D>& stages = builder.stages;
    const auto contact = std::make_shared<RigidContact<D>>(RigidContact<D>{
        .body = read_body<D>(builder.values), .friction = builder.values.number("friction")});
    check_apart(contact->body, builder.scene);
    add_contact<D>(builder, contact);
    const auto move = [contact, loads = read_loads<D>(builder, contact->body),
                       // Friction uses means over the time in which a wave crosses six cells.
                       rate = builder.wave_speed / (6 * builder.scene.grid.spacing)](
                          const StepTime& step, MPI_Comm comm) {
        move_body(*contact, loads, step, -std::expm1(-step.time_step * rate), comm);
    };
    stages.ends.push_back({"penetrator", move});
    stages.reports.push_back({"penetrator_tip_y", [=] { return contact->body.tip[1]; }});
    stages.reports.push_back({"penetrator_velocity", [=] { return contact->body.velocity; }});
    stages.reports.push_back({"penetrator_force", [=] { return -contact->last_force; }});
    stages.kept = {&contact->body.tip[1], &contact->body.velocity, &contact->force,
                   &contact->last_force};
    if (contact->bands)
        for (double& mean : contact->bands->means()) stages.kept.push_back(&mean);
}

}  // namespace

/// Adds a rigid upright cylinder with a conical tip; in two dimensions it is a wall with a wedge.
/// It moves along y by its weight, the contact forces of the soil and those of still fluid. A side
/// of the domain may be a plane of symmetry of the body.
///
/// Friction is at most friction * normal force and, if adhesion_factor is given, at most
/// adhesion_factor * undrained strength * area.
EffectKind penetrator_effect() {
    return {
        "penetrator",
        {vector("tip", "m"), positive("radius", "m"), not_negative("cone_height", "m", 0.0),
         positive("length", "m"), positive("mass", "kg"), number("velocity", "m/s", 0.0),
         not_negative("fluid_density", "kg/m^3", 0.0), not_negative("drag_coefficient", "", 0.0),
         not_negative("friction", "", 0.0), optional(not_negative("adhesion_factor", ""))},
        build<2>,
        build<3>};
}

}  // namespace mpm
