#include "effects/penetrator/rigid_contact.hpp"

namespace mpm {

namespace {

template <int D>
struct ContactColumns {
    MotionColumns motion;
    std::array<Column, D> force{};
    double largest = 0;  ///< half the width of a point, m
};

/// The forces of one step.
template <int D>
class Pusher {
  public:
    Pusher(RigidContact<D>& contact, const ContactColumns<D>& columns, const Particles& particles,
           const PointBlock<D>& block)
        : contact_(contact), columns_(columns), particles_(particles), block_(block) {
        // By the time the force acts the body will have moved on.
        body_ = contact.body;
        body_.tip[1] += block.time_step * body_.velocity;
        time_ = contact.times.contact(body_.velocity, block.time_step);
        ahead_ = time_ * std::abs(body_.velocity);
    }

    std::optional<Components<D>> force_on(std::size_t p) const {
        const Vector at = position(p);
        // Most points are far away: a point is at most as large as a cell.
        if (!body_.touch(at, columns_.largest + ahead_)) return std::nullopt;
        const double width = std::pow(particles_[columns_.motion.volume][p], 1.0 / D);
        const double reach = std::min(0.5 * width, columns_.largest) + ahead_;
        const auto touch = body_.touch(at, reach);
        if (!touch) return std::nullopt;
        Components<D> velocity;
        for (std::size_t a = 0; a < D; ++a)
            velocity[a] = particles_[columns_.motion.velocity[a]][p];
        velocity[1] -= body_.velocity;
        const Slip<D> slip = slip_of<D>(velocity, touch->normal);
        const double mass_rate = particles_[columns_.motion.mass][p] / time_;
        const double normal_force =
            mass_rate * std::max(0.0, lost_speed<D>(slip, touch->depth - ahead_, time_));
        const double most =
            std::min(friction_on(p, at[1] - body_.tip[1], normal_force), mass_rate * slip.speed);
        return contact_force<D>(slip, touch->normal, normal_force, most);
    }

  private:
    Vector position(std::size_t p) const {
        Vector at{};
        for (std::size_t a = 0; a < D; ++a) at[a] = particles_[columns_.motion.position[a]][p];
        return at;
    }

    double friction_on(std::size_t p, double height, double normal_force) const {
        const SkinFriction<D>& skin = contact_.skin;
        if (!contact_.bands) return skin.coefficient * normal_force;
        contact_.bands->add(height, normal_force, skin.limit(particles_, block_, p));
        return contact_.bands->most_at(height, skin.coefficient) * normal_force;
    }

    RigidContact<D>& contact_;
    const ContactColumns<D>& columns_;
    const Particles& particles_;
    const PointBlock<D>& block_;
    Penetrator<D> body_;
    double time_ = 0;   ///< of contact, s
    double ahead_ = 0;  ///< what the body moves in it, m
};

template <int D>
PointKernel<D> force_kernel(const std::shared_ptr<RigidContact<D>>& contact,
                            const ContactColumns<D>& columns) {
    return [=](Particles& particles, const PointBlock<D>& block) {
        const Pusher<D> pusher(*contact, columns, particles, block);
        std::array<double*, D> forces;
        for (std::size_t a = 0; a < D; ++a) {
            forces[a] = particles.data(columns.force[a]);
            std::fill(forces[a] + block.begin, forces[a] + block.end, 0.0);
        }
        for (std::size_t p = block.begin; p < block.end; ++p) {
            const auto force = pusher.force_on(p);
            if (!force) continue;
            for (std::size_t a = 0; a < D; ++a) forces[a][p] = (*force)[a];
            contact->next_force += (*force)[1];
        }
    };
}

}  // namespace

template <int D>
void add_contact(const EffectBuilder<D>& builder, const std::shared_ptr<RigidContact<D>>& contact) {
    Stages<D>& stages = builder.stages;
    ContactColumns<D> columns{.motion = add_motion_columns(builder.particles, D),
                              .largest = 0.5 * builder.scene.grid.spacing};
    const std::size_t first = stages.fields.size();
    for (std::size_t a = 0; a < D; ++a) {
        columns.force[a] = builder.particles.add_column(std::string("contact_force_") + "xyz"[a]);
        stages.fields.push_back({"contact", columns.force[a], -1, static_cast<int>(a)});
    }
    stages.forces.push_back({"contact", [=](GridPatch<D>& patch, const StepTime&) {
                                 for (std::size_t a = 0; a < D; ++a)
                                     for (std::size_t n = 0; n < patch.sums.size(); ++n)
                                         patch.sums[n].force[a] += patch.fields[first + a][n];
                             }});
    stages.after_materials.push_back({"contact", force_kernel<D>(contact, columns)});
}

template void add_contact<2>(const EffectBuilder<2>&, const std::shared_ptr<RigidContact<2>>&);
template void add_contact<3>(const EffectBuilder<3>&, const std::shared_ptr<RigidContact<3>>&);

}  // namespace mpm
