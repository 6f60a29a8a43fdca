#include "../penetrator.hpp"

#include <mpm/effect.hpp>

#include <memory>
#include <stdexcept>

namespace mpm {

namespace {

constexpr std::size_t vertical = 1;

/// The soil's side of a contact, and the impulse the soil has been given in this step, N s.
template <int D>
struct Contact {
    Penetrator<D> body;
    double friction = 0;
    std::optional<double> adhesion = {};  ///< most shear traction, Pa
    std::size_t area_field = 0;           ///< first component, where there is adhesion
    double impulse = 0;                   ///< on the counted nodes of this rank
    double force = 0;                     ///< on the body in the last step, N
};

/// The most a node's velocity along the surface can lose, m/s.
template <int D>
double most_lost(const Contact<D>& contact, const GridPatch<D>& patch, std::size_t n,
                 double time_step) {
    if (!contact.adhesion) return std::numeric_limits<double>::infinity();
    double square = 0;
    for (std::size_t a = 0; a < D; ++a) {
        const double area = patch.fields[contact.area_field + a][n];
        square += area * area;
    }
    return *contact.adhesion * std::sqrt(square) * time_step / patch.sums[n].mass;
}

template <int D>
void push_nodes(Contact<D>& contact, GridPatch<D>& patch, const StepTime& step) {
    contact.impulse = 0;
    visit_nodes<D>(patch.nodes, [&](const std::array<int, D>& node) {
        const std::size_t n = patch.index(node);
        if (!(patch.sums[n].mass > 0)) return;
        const auto normal = contact.body.normal_inside(patch.position(node));
        if (!normal) return;
        Surface<D> surface{
            *normal, contact.friction, {}, most_lost(contact, patch, n, step.time_step)};
        surface.velocity[vertical] = contact.body.velocity;
        const double before = patch.motion[n].velocity[vertical];
        meet<D>(surface, patch.motion[n]);
        if (patch.is_counted[n] != 0)
            contact.impulse += patch.sums[n].mass * (patch.motion[n].velocity[vertical] - before);
    });
}

/// The body's own equation of motion, with one reduction.
template <int D>
void move_body(Contact<D>& contact, const Gravity<D>& gravity, const StepTime& step,
               MPI_Comm comm) {
    double impulse = 0;
    MPI_Reduce(&contact.impulse, &impulse, 1, MPI_DOUBLE, MPI_SUM, 0, comm);
    MPI_Bcast(&impulse, 1, MPI_DOUBLE, 0, comm);
    const double weight = gravity.acceleration[vertical] * gravity.share_at(step.time);
    contact.force = -impulse / step.time_step;
    contact.body.velocity += step.time_step * weight - impulse / contact.body.mass;
    contact.body.tip[vertical] += step.time_step * contact.body.velocity;
}

template <int D>
Contact<D> read(const Values& values) {
    Contact<D> contact;
    Penetrator<D>& body = contact.body;
    std::copy_n(values.list("tip").begin(), D, body.tip.begin());
    body.radius = values.number("radius");
    body.cone_height = values.number("cone_height");
    body.length = values.number("length");
    body.mass = values.number("mass");
    body.velocity = values.number("velocity");
    if (body.cone_height > body.length)
        throw std::invalid_argument(
            "effects / penetrator: 'cone_height' must be at most the length");
    contact.friction = values.number("friction");
    if (values.has("adhesion")) contact.adhesion = values.number("adhesion");
    return contact;
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    Stages<D>& stages = builder.stages;
    const auto contact = std::make_shared<Contact<D>>(read<D>(builder.values));
    Gravity<D> gravity = stages.gravity.value_or(Gravity<D>{});
    gravity.acceleration[vertical] *= builder.values.number("weight_share");
    if (contact->adhesion) {
        contact->area_field = stages.fields.size();
        const Column volume = builder.particles.add_column("volume");
        for (int axis = 0; axis < D; ++axis)
            stages.fields.push_back({"contact_area", volume, axis});
    }
    stages.counts_nodes = true;
    stages.moved.push_back({"penetrator", [contact](GridPatch<D>& patch, const StepTime& step) {
                                push_nodes(*contact, patch, step);
                            }});
    stages.ends.push_back({"penetrator", [=](const StepTime& step, MPI_Comm comm) {
                               move_body(*contact, gravity, step, comm);
                           }});
    stages.reports.push_back({"penetrator_tip_y", [=] { return contact->body.tip[vertical]; }});
    stages.reports.push_back({"penetrator_velocity", [=] { return contact->body.velocity; }});
    stages.reports.push_back({"penetrator_force", [=] { return contact->force; }});
}

}  // namespace

/// A rigid upright cylinder with a conical tip, in two dimensions a wall with a wedge, that moves
/// along y by its weight and the forces of the soil: contact at the nodes inside it, without
/// tension, and friction of at most friction * normal force and adhesion * area.
EffectKind penetrator_effect() {
    return {"penetrator",
            {vector("tip", "m"), positive("radius", "m"), not_negative("cone_height", "m", 0.0),
             positive("length", "m"), positive("mass", "kg"), number("velocity", "m/s", 0.0),
             number("weight_share", "", 1.0), not_negative("friction", "", 0.0),
             optional(not_negative("adhesion", "Pa"))},
            build<2>,
            build<3>};
}

}  // namespace mpm
