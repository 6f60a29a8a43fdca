#include "simulation_mpi.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>

namespace comparisons {

namespace {

/// Seconds `action` takes on this rank, all ranks starting together.
template <typename Action>
double timed(Action&& action, MPI_Comm comm) {
    MPI_Barrier(comm);
    const double start = MPI_Wtime();
    action();
    return MPI_Wtime() - start;
}

LoadRecord record_load(const mpm::Simulation& simulation, MPI_Comm comm) {
    int size = 0;
    MPI_Comm_size(comm, &size);
    LoadRecord record{simulation.step_count(), simulation.time(),
                      std::vector<double>(static_cast<std::size_t>(size))};
    const auto count = static_cast<double>(simulation.positions().x.size());
    MPI_Allgather(&count, 1, MPI_DOUBLE, record.points.data(), 1, MPI_DOUBLE, comm);
    return record;
}

void run_steps(SimulationRun& run, mpm::Simulation& simulation, const SimulationPlan& plan,
               const std::optional<mpm::Balancer>& balancer, const Observer& observe,
               MPI_Comm comm) {
    for (int step = 0; step < plan.num_steps; ++step) {
        if (balancer && step % plan.every == 0) {
            run.balance_s += timed([&] { simulation.rebalance(*balancer); }, comm);
        }
        if (step % plan.record_every == 0) run.history.push_back(record_load(simulation, comm));
        run.step_s += timed([&] { simulation.step(); }, comm);
        observe(step + 1, simulation);
    }
}

void note_state(SimulationRun& run, const mpm::Simulation& simulation, MPI_Comm comm) {
    const mpm::Particles& particles = simulation.particles();
    const auto x = particles["x"];
    const auto mass = particles["mass"];
    const auto across = particles["displacement_x"];
    const auto up = particles["displacement_y"];
    for (std::size_t i = 0; i < particles.size(); ++i) {
        run.mass_kg += mass[i];
        if (std::hypot(across[i], up[i]) > 1) run.front_m = std::max(run.front_m, x[i]);
    }
    double slowest[] = {run.front_m, run.balance_s, run.step_s};
    MPI_Allreduce(MPI_IN_PLACE, slowest, 3, MPI_DOUBLE, MPI_MAX, comm);
    MPI_Allreduce(MPI_IN_PLACE, &run.mass_kg, 1, MPI_DOUBLE, MPI_SUM, comm);
    run.front_m = slowest[0];
    run.balance_s = slowest[1];
    run.step_s = slowest[2];
    run.wall_s = run.balance_s + run.step_s;
}

void note_imbalance(SimulationRun& run) {
    double sum = 0;
    for (const LoadRecord& record : run.history) {
        const double imbalance = rrcb::imbalance(record.points);
        sum += imbalance;
        run.worst_imbalance = std::max(run.worst_imbalance, imbalance);
    }
    run.mean_imbalance = sum / static_cast<double>(run.history.size());
}

}  // namespace

SimulationRun simulate(const SimulationPlan& plan, const std::optional<mpm::Balancer>& balancer,
                       const Observer& observe, MPI_Comm comm) {
    SimulationRun run;
    try {
        mpm::Simulation simulation(plan.scene, comm);
        run.num_points = simulation.num_points();
        observe(0, simulation);
        run_steps(run, simulation, plan, balancer, observe, comm);
        note_state(run, simulation, comm);
        note_imbalance(run);
    } catch (const std::runtime_error& error) {
        run.error = error.what();
    }
    return run;
}

int steps_to_end(const mpm::Scene& scene, MPI_Comm comm) {
    const mpm::Simulation simulation(scene, comm);
    return std::max(1, static_cast<int>(std::ceil(scene.end_time / simulation.time_step())));
}

}  // namespace comparisons
