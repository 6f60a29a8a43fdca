#include "effects/effect.hpp"
#include "effects/penetrator/fluid_loads.hpp"
#include "effects/penetrator/rigid_contact.hpp"
#include "effects/penetrator/skin_friction.hpp"
#include "parallel/communicator_mpi.hpp"
#include "scene/lattice.hpp"

#include <algorithm>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace mpm {

namespace {

constexpr std::size_t vertical = 1;

/// Motion of the body: its inertia and loads, and its energy.
template <int D>
struct Motion {
    Gravity<D> gravity;                   ///< times `weight_share`
    double inertia = 0;                   ///< mass and added mass, kg
    std::vector<BodyLoad<D>> loads = {};  ///< beside weight and soil
    double force = 0;                     ///< of the soil on it in the last step, N
    double kinetic_at_start = 0;          ///< J
    double potential = 0;                 ///< of weight and buoyancy, 0 at the start, J
    bool is_counting_rank = false;        ///< whether this rank tells the body's loss, as one does
};

template <int D>
double kinetic_energy(const Motion<D>& motion, const Penetrator<D>& body) {
    return 0.5 * motion.inertia * body.velocity * body.velocity;
}

/// Force on the soil in this step. Settles the sums of the contact. Collective: one reduction.
template <int D>
double sum_of_ranks(RigidContact<D>& contact, double time_step, MPI_Comm comm) {
    std::vector<double> sums{contact.force};
    if (contact.bands)
        sums.insert(sums.end(), contact.bands->sums().begin(), contact.bands->sums().end());
    std::vector<double> total(sums.size());
    const auto count = static_cast<int>(sums.size());
    MPI_Reduce(sums.data(), total.data(), count, MPI_DOUBLE, MPI_SUM, 0, comm);
    MPI_Bcast(total.data(), count, MPI_DOUBLE, 0, comm);
    if (contact.bands)
        contact.bands->settle(std::span(total).subspan(1), contact.times.weight(time_step));
    contact.force = std::exchange(contact.next_force, 0);
    return total.front();
}

/// Moves the body by its equation of motion. Collective.
template <int D>
void move_body(RigidContact<D>& contact, Motion<D>& motion, const StepTime& step, MPI_Comm comm) {
    const double push = sum_of_ranks(contact, step.time_step, comm);
    motion.is_counting_rank = rank_of(comm) == 0;
    Penetrator<D>& body = contact.body;
    const Gravity<D>& gravity = motion.gravity;
    double weight = body.mass * gravity.acceleration[vertical] * gravity.share_at(step.time);
    double drag = 0;
    for (const BodyLoad<D>& load : motion.loads)
        (load.does_return_work ? weight : drag) += load.force(body, step);
    motion.force = -push;
    body.velocity += step.time_step * (weight + drag - push) / motion.inertia;
    body.tip[vertical] += step.time_step * body.velocity;
    motion.potential -= step.time_step * weight * body.velocity;
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
    visit_points(scene, [&](const Body& soil, const Vector& at) {
        const Vector size = lattice_spacing(scene, soil);
        const auto touch = body.touch(at, 0);
        if (!touch || touch->depth <= 0.5 * *std::max_element(size.begin(), size.begin() + D))
            return;
        std::ostringstream text;
        text << "effects / penetrator: the body '" << soil.name << "' begins in it at x = " << at[0]
             << ", y = " << at[1] << ", z = " << at[2]
             << " m; subtract its shape from the body, or place its 'tip' elsewhere";
        throw std::invalid_argument(text.str());
    });
}

template <int D>
Motion<D> read_motion(const EffectBuilder<D>& builder, const Penetrator<D>& body) {
    const Values& values = builder.values;
    if (values.has("weight_share") && values.has("fluid_density"))
        throw std::invalid_argument(
            "effects / penetrator: give 'weight_share' or 'fluid_density', not both");
    Motion<D> motion{.gravity = builder.stages.gravity.value_or(Gravity<D>{}),
                     .inertia = body.mass + values.number("added_mass"),
                     .loads = fluid_loads<D>(builder, body)};
    if (values.has("weight_share"))
        motion.gravity.acceleration[vertical] *= values.number("weight_share");
    motion.kinetic_at_start = kinetic_energy(motion, body);
    return motion;
}

/// Reports the body's energy to the scene, with its loss apart from the soil's.
template <int D>
void report(const std::shared_ptr<RigidContact<D>>& contact,
            const std::shared_ptr<Motion<D>>& motion, Stages<D>& stages) {
    stages.reports.push_back({"penetrator_tip_y", [=] { return contact->body.tip[vertical]; }});
    stages.reports.push_back({"penetrator_velocity", [=] { return contact->body.velocity; }});
    stages.reports.push_back({"penetrator_force", [=] { return motion->force; }});
    stages.rigid_energies.push_back([=]() -> RigidEnergy {
        return {kinetic_energy(*motion, contact->body), motion->potential};
    });
    stages.dissipated.push_back([=](const Particles&) {
        if (!motion->is_counting_rank) return 0.0;
        return motion->kinetic_at_start - kinetic_energy(*motion, contact->body) -
               motion->potential;
    });
}

/// Lets a written state hold the body and the means of its friction.
template <int D>
void keep_state(const std::shared_ptr<RigidContact<D>>& contact,
                const std::shared_ptr<Motion<D>>& motion, Stages<D>& stages) {
    const auto save = [=] {
        std::vector<double> state{contact->body.tip[vertical], contact->body.velocity,
                                  motion->potential, motion->force};
        if (!contact->bands) return state;
        const auto means = contact->bands->means();
        state.insert(state.end(), means.begin(), means.end());
        return state;
    };
    const auto load = [=](std::span<const double> state) {
        contact->body.tip[vertical] = state[0];
        contact->body.velocity = state[1];
        motion->potential = state[2];
        motion->force = state[3];
        if (contact->bands) contact->bands->resume(state.subspan(4));
    };
    stages.states.push_back({save, load, false});
    const auto save_own = [=] {
        return std::vector<double>{contact->force, motion->is_counting_rank ? 1.0 : 0.0};
    };
    const auto load_own = [=](std::span<const double> state) {
        contact->force = state[0];
        motion->is_counting_rank = state[1] > 0;
    };
    stages.states.push_back({save_own, load_own, true});
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    Stages<D>& stages = builder.stages;
    const auto contact =
        std::make_shared<RigidContact<D>>(RigidContact<D>{.body = read_body<D>(builder.values),
                                                          .skin = skin_friction<D>(builder),
                                                          .times = ContactTimes(builder)});
    check_apart(contact->body, builder.scene);
    const auto motion = std::make_shared<Motion<D>>(read_motion<D>(builder, contact->body));
    if (contact->skin.limit)
        contact->bands.emplace(contact->body, builder.scene.grid.spacing,
                               contact->body.share_in(builder.scene.grid));
    add_contact<D>(builder, contact);
    stages.ends.push_back({"penetrator", [=](const StepTime& step, MPI_Comm comm) {
                               move_body(*contact, *motion, step, comm);
                           }});
    report(contact, motion, stages);
    keep_state(contact, motion, stages);
}

std::vector<Rule> rules() {
    std::vector<Rule> rules{vector("tip", "m"),
                            positive("radius", "m"),
                            not_negative("cone_height", "m", 0.0),
                            positive("length", "m"),
                            positive("mass", "kg"),
                            number("velocity", "m/s", 0.0),
                            optional(number("weight_share", "")),
                            not_negative("added_mass", "kg", 0.0)};
    for (Rule& rule : skin_friction_rules()) rules.push_back(std::move(rule));
    for (Rule& rule : fluid_rules()) rules.push_back(std::move(rule));
    return rules;
}

}  // namespace

/// A rigid upright cylinder with a conical tip, in two dimensions a wall with a wedge, that moves
/// along y by its weight and the forces of the soil, of fluid and of added mass on request.
///
/// Friction is at most friction * normal force and adhesion * area, where adhesion is a number or a
/// share of the soil's undrained strength.
EffectKind penetrator_effect() {
    return {"penetrator", rules(), build<2>, build<3>};
}

}  // namespace mpm
