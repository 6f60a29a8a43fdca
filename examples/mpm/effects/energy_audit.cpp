#include "effects/effect.hpp"

#include <memory>

namespace mpm {

namespace {

/// Account of the nodes this rank stands for, over a step and since the start.
template <int D>
struct Ledger {
    std::vector<Components<D>> start;    ///< velocity the step begins with
    std::vector<Components<D>> jump;     ///< from the strain velocity of the last step to it
    std::vector<Components<D>> impulse;  ///< of all forces but stress and full weight
    std::vector<NodeSums<D>> before;     ///< a kernel of forces
    double lost_to_forces = 0;           ///< of all impulses, J
    double lost_between_steps = 0;       ///< where stress works on other velocities than strain, J
    double gained_by_nodes = 0;          ///< kinetic energy over all steps, J
    double kinetic_at_start = 0;         ///< of the points, J
    bool has_begun = false;
};

template <int D>
double kinetic_energy(const Particles& particles, const MotionColumns& motion) {
    double energy = 0;
    for (std::size_t a = 0; a < D; ++a) {
        const auto velocity = particles[motion.velocity[a]], mass = particles[motion.mass];
        for (std::size_t p = 0; p < mass.size(); ++p)
            energy += 0.5 * mass[p] * velocity[p] * velocity[p];
    }
    return energy;
}

/// Opens the account of a step with the impulse of full weight, taken away.
///
/// Potential energy is that of full weight. So what a ramp still withholds of it counts as a force
/// that takes energy.
template <int D>
void open_step(Ledger<D>& ledger, const GridPatch<D>& patch, const Components<D>& gravity,
               double time_step) {
    ledger.impulse.resize(patch.sums.size());
    for (std::size_t n = 0; n < patch.sums.size(); ++n)
        for (std::size_t a = 0; a < D; ++a)
            ledger.impulse[n][a] = -time_step * patch.sums[n].mass * gravity[a];
}

/// Notes the velocities before the step.
///
/// A held node has no velocity, so no force does work on it. The points keep the momentum that they
/// handed it.
template <int D>
void note_start(Ledger<D>& ledger, const GridPatch<D>& patch) {
    ledger.start.assign(patch.sums.size(), Components<D>{});
    ledger.jump.assign(patch.sums.size(), Components<D>{});
    for (std::size_t n = 0; n < patch.sums.size(); ++n) {
        if (!(patch.sums[n].mass > 0)) continue;
        // The last step leaves a node without points at 0. One that sticks to a wall is told from
        // it by its change of velocity.
        const NodeMotion<D>& last = patch.motion[n];
        const bool was_there =
            last.velocity != Components<D>{} || last.velocity_change != Components<D>{};
        for (std::size_t a = 0; a < D; ++a) {
            ledger.start[n][a] = patch.sums[n].momentum[a] / patch.sums[n].mass;
            if (was_there) ledger.jump[n][a] = ledger.start[n][a] - last.strain_velocity[a];
        }
    }
}

/// Adds the losses of the step.
///
/// An impulse does the work impulse * mean of the velocities before and after. The points see the
/// work of stress with their strain velocities. Those differ: before, they are of the last step's
/// end; after, they are bounded where a node has next to no mass. The difference is lost.
template <int D>
void close_step(Ledger<D>& ledger, const GridPatch<D>& patch) {
    for (std::size_t n = 0; n < patch.sums.size(); ++n) {
        const double mass = patch.sums[n].mass;
        if (patch.is_counted[n] == 0 || !(mass > 0)) continue;
        for (std::size_t a = 0; a < D; ++a) {
            const double before = ledger.start[n][a], after = patch.motion[n].velocity[a];
            const double of_stress = mass * (after - before) - ledger.impulse[n][a];
            ledger.lost_to_forces -= 0.5 * (before + after) * ledger.impulse[n][a];
            ledger.lost_between_steps -=
                0.5 * of_stress * (ledger.jump[n][a] + after - patch.motion[n].strain_velocity[a]);
            ledger.gained_by_nodes += 0.5 * mass * (after * after - before * before);
        }
    }
}

/// Kernel of forces that also notes the impulse it gives.
template <int D>
NodeKernel<D> noted(NodeKernel<D> kernel, const std::shared_ptr<Ledger<D>>& ledger) {
    return [=](GridPatch<D>& patch, const StepTime& step) {
        ledger->before = patch.sums;
        kernel(patch, step);
        for (std::size_t n = 0; n < patch.sums.size(); ++n)
            for (std::size_t a = 0; a < D; ++a)
                ledger->impulse[n][a] +=
                    step.time_step * (patch.sums[n].force[a] - ledger->before[n].force[a]);
    };
}

/// Kernel of moved nodes that also notes the impulse it gives.
template <int D>
NodeKernel<D> noted_motion(NodeKernel<D> kernel, const std::shared_ptr<Ledger<D>>& ledger) {
    return [=](GridPatch<D>& patch, const StepTime& step) {
        const auto note = [&](double sign) {
            for (std::size_t n = 0; n < patch.sums.size(); ++n)
                for (std::size_t a = 0; a < D; ++a)
                    ledger->impulse[n][a] +=
                        sign * patch.sums[n].mass * patch.motion[n].velocity[a];
        };
        note(-1);
        kernel(patch, step);
        note(1);
    };
}

/// Kernel of half the work of the present stress over the step.
///
/// It runs before and after the materials: both halves together are the work of the mean stress.
template <int D>
PointKernel<D> work_kernel(const StressColumns<D>& stress, Column volume, Column work) {
    return [=](Particles& particles, const PointBlock<D>& block) {
        const StressPointers<D> stresses = stress_pointers<D>(particles, stress);
        const StepGradients<D> gradients(block);
        for (std::size_t p = block.begin; p < block.end; ++p) {
            const DisplacementGradient<D> g = gradients[p - block.begin];
            const Stress<D> s = load<D>(stresses, p);
            double density = s.xx * g[0][0] + s.yy * g[1][1] + s.xy * (g[0][1] + g[1][0]);
            if constexpr (D == 3)
                density += s.zz * g[2][2] + s.yz * (g[1][2] + g[2][1]) + s.zx * (g[2][0] + g[0][2]);
            particles.data(work)[p] += 0.5 * particles[volume][p] * density;
        }
    };
}

template <int D>
void build(const EffectBuilder<D>& builder) {
    Stages<D>& stages = builder.stages;
    const MotionColumns motion = add_motion_columns(builder.particles, D);
    const auto ledger = std::make_shared<Ledger<D>>();
    for (auto& effect : stages.forces) effect.kernel = noted<D>(effect.kernel, ledger);
    for (auto& effect : stages.moved) effect.kernel = noted_motion<D>(effect.kernel, ledger);
    const Gravity<D> gravity = stages.gravity.value_or(Gravity<D>{});
    const auto open = [=, &particles = builder.particles](GridPatch<D>& patch,
                                                          const StepTime& step) {
        if (!ledger->has_begun) ledger->kinetic_at_start = kinetic_energy<D>(particles, motion);
        ledger->has_begun = true;
        open_step<D>(*ledger, patch, gravity.acceleration, step.time_step);
    };
    stages.forces.insert(stages.forces.begin(), {"energy_audit", open});
    stages.constraints.push_back({"energy_audit", [ledger](GridPatch<D>& patch, const StepTime&) {
                                      note_start(*ledger, patch);
                                  }});
    // After all kernels that change the strain velocities.
    stages.moved.push_back({"energy_audit", [ledger](GridPatch<D>& patch, const StepTime&) {
                                close_step(*ledger, patch);
                            }});
    stages.work = {builder.particles.add_column("internal_work"),
                   builder.particles.add_column("plastic_work")};
    const PointKernel<D> work = work_kernel<D>(add_stress_columns<D>(builder.particles),
                                               motion.volume, stages.work->internal);
    stages.before_materials.push_back({"energy_audit", work});
    stages.after_materials.push_back({"energy_audit", work});
    stages.dissipated.push_back([ledger](const Particles&) { return ledger->lost_to_forces; });
    // The transfer between nodes and points takes the energy that only the nodes gained.
    stages.transfer_loss = [ledger, motion](const Particles& particles) {
        if (!ledger->has_begun) return 0.0;
        return ledger->lost_between_steps + ledger->gained_by_nodes -
               (kinetic_energy<D>(particles, motion) - ledger->kinetic_at_start);
    };
    stages.states.push_back({[ledger] {
                                 return std::vector<double>{
                                     ledger->lost_to_forces, ledger->lost_between_steps,
                                     ledger->gained_by_nodes, ledger->kinetic_at_start};
                             },
                             [ledger](std::span<const double> state) {
                                 ledger->lost_to_forces = state[0];
                                 ledger->lost_between_steps = state[1];
                                 ledger->gained_by_nodes = state[2];
                                 ledger->kinetic_at_start = state[3];
                             },
                             true});
    stages.states.push_back(
        {[ledger] { return std::vector<double>{ledger->has_begun ? 1.0 : 0.0}; },
         [ledger](std::span<const double> state) { ledger->has_begun = state[0] > 0; }, false});
    stages.counts_nodes = true;
    stages.carries_motion = true;
}

}  // namespace

/// Account of the energy dissipated by plastic strain and on the nodes (walls, damping, drag), and
/// apart from it of what the transfers between points and nodes lose.
EffectKind energy_audit_effect() {
    return {"energy_audit", {}, build<2>, build<3>};
}

}  // namespace mpm
