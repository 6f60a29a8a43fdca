#include "effects/effect.hpp"
#include "effects/penetrator/contact.hpp"
#include "scene/lattice.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace mpm {

namespace {

/// Loads on the body beside the soil.
template <int D>
struct Loads {
    Gravity<D> gravity;
    double heavy_mass = 0;   ///< mass that has weight, less the fluid displaced, kg
    double drag_factor = 0;  ///< drag by the square of the speed, kg/m
};

/// Adds up over the ranks, moves the body by its equation of motion and begins the next step.
/// Collective: one reduction.
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
    // Implicit in the speed, drag never turns the body back.
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

/// Throws std::invalid_argument for a point that begins in the body by more than half its size, as
/// contact would hurl it out. All ranks look at all points.
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
            .heavy_mass = values.number("weight_share") * body.mass - fluid * body.volume(),
            .drag_factor = 0.5 * fluid * values.number("drag_coefficient") * body.section()};
}

/// Lets a written state contain the body, its force and the means of its friction.
template <int D>
EffectState state_of(const std::shared_ptr<RigidContact<D>>& contact) {
    const auto save = [=] {
        std::vector<double> state{contact->body.tip[1], contact->body.velocity, contact->force,
                                  contact->last_force};
        if (!contact->bands) return state;
        const auto means = contact->bands->means();
        state.insert(state.end(), means.begin(), means.end());
        return state;
    };
    const auto load = [=](std::span<const double> state) {
        contact->body.tip[1] = state[0];
        contact->body.velocity = state[1];
        contact->force = state[2];
        contact->last_force = state[3];
        if (contact->bands) contact->bands->resume(state.subspan(4));
    };
    return {save, load};
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    Stages<D>& stages = builder.stages;
    const auto contact = std::make_shared<RigidContact<D>>(RigidContact<D>{
        .body = read_body<D>(builder.values), .friction = builder.values.number("friction")});
    check_apart(contact->body, builder.scene);
    add_contact<D>(builder, contact);
    const auto move = [contact, loads = read_loads<D>(builder, contact->body),
                       // The means of friction are over the time of a wave through six cells.
                       rate = builder.wave_speed / (6 * builder.scene.grid.spacing)](
                          const StepTime& step, MPI_Comm comm) {
        move_body(*contact, loads, step, -std::expm1(-step.time_step * rate), comm);
    };
    stages.ends.push_back({"penetrator", move});
    stages.reports.push_back({"penetrator_tip_y", [=] { return contact->body.tip[1]; }});
    stages.reports.push_back({"penetrator_velocity", [=] { return contact->body.velocity; }});
    stages.reports.push_back({"penetrator_force", [=] { return -contact->last_force; }});
    stages.states.push_back(state_of(contact));
}

}  // namespace

/// A rigid upright cylinder with a conical tip, in two dimensions a wall with a wedge, that moves
/// along y by its weight and the forces of the soil and of still fluid around all of it. Symmetry
/// cuts a body on a side of the domain.
///
/// Friction is at most friction * normal force and, if it is given, adhesion_factor * undrained
/// strength * area.
EffectKind penetrator_effect() {
    return {"penetrator",
            {vector("tip", "m"), positive("radius", "m"), not_negative("cone_height", "m", 0.0),
             positive("length", "m"), positive("mass", "kg"), number("velocity", "m/s", 0.0),
             number("weight_share", "", 1.0), not_negative("fluid_density", "kg/m^3", 0.0),
             not_negative("drag_coefficient", "", 0.0), not_negative("friction", "", 0.0),
             optional(not_negative("adhesion_factor", ""))},
            build<2>,
            build<3>};
}

}  // namespace mpm
