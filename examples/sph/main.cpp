// Smoothed particle hydrodynamics in a periodic box: densities, then forces between pairs.
#include "fluid.hpp"

#include <rrcb/rrcb.hpp>

#include <cstdio>

constexpr double skin = 0.02;
constexpr double time_step = 0.002;
constexpr double cost =
    20000;  // of a rebalance, in pairs like the loads; a simulation uses seconds

Particles simulate(Particles own, int num_steps, MPI_Comm comm) {
    using rrcb::column;
    rrcb::Controller controller(comm);
    rrcb::Balance balance;
    rrcb::GhostPlan near;
    std::vector<int> numbers;
    double travelled = skin;
    for (int step = 0; step < num_steps; ++step) {
        if (2 * travelled >= skin) {  // otherwise the plan might miss pairs
            for (double& x : own.positions) x -= std::floor(x);
            // A denser particle has more pairs, so it weighs more.
            const rrcb::Points points(own.positions, 2, own.densities);
            const bool is_due = step == 0 || controller.due();
            if (is_due) balance = rrcb::balance(points, comm, {}, balance.cuts);
            if (is_due) controller.rebalanced({.cost = cost, .report = &balance.report});
            if (!is_due) balance.parts = rrcb::assign(balance.cuts, points, comm);
            const auto columns = rrcb::columns(column(own.positions, 2), column(own.velocities, 2),
                                               column(own.numbers));
            std::tie(own.positions, own.velocities, own.numbers) =
                rrcb::transfer(rrcb::plan(balance, comm), columns, comm);
            near = rrcb::ghost_plan(balance.cuts, rrcb::Points(own.positions, 2), comm,
                                    {.cutoff = reach + skin, .periodic = {{{0, 0}, {1, 1}}}});
            numbers = joined(own.numbers, rrcb::fetch(near, own.numbers, comm));
            travelled = 0;
        }
        const std::size_t count = own.numbers.size();
        std::vector<double> ghosts = rrcb::fetch(near, column(own.positions, 2), comm);
        rrcb::apply_shifts(near, ghosts);
        const std::vector<double> x = joined(own.positions, ghosts);
        const std::vector<Pair> pairs = pairs_among(x, count);
        own.densities.assign(count, kernel(0));
        for (const auto& [i, j, distance] : pairs) {
            own.densities[i] += kernel(distance);
            if (j < count) own.densities[j] += kernel(distance);
        }
        const auto densities = joined(own.densities, rrcb::fetch(near, own.densities, comm));
        std::vector<double> forces(x.size());
        for (const auto& [i, j, distance] : pairs) {
            // the other rank computes it
            if (j >= count && numbers[i] > numbers[j]) continue;
            for (std::size_t a = 0; a < 2; ++a) {
                const double force =
                    push(distance, densities[i], densities[j]) * (x[2 * i + a] - x[2 * j + a]);
                forces[2 * i + a] += force;
                forces[2 * j + a] -= force;
            }
        }
        const std::span all(forces);
        const std::vector<double> sums = rrcb::accumulate(near, column(all.subspan(2 * count), 2),
                                                          column(all.first(2 * count), 2), comm);
        double fastest = 0;
        for (std::size_t k = 0; k < 2 * count; ++k) {
            own.velocities[k] += time_step * sums[k];
            own.positions[k] += time_step * own.velocities[k];
            fastest = std::max(fastest, std::abs(own.velocities[k]));
        }
        MPI_Allreduce(MPI_IN_PLACE, &fastest, 1, MPI_DOUBLE, MPI_MAX, comm);
        travelled += time_step * fastest * std::sqrt(2);
        controller.step(
            {.load = static_cast<double>(pairs.size()), .weight = static_cast<double>(count)});
    }
    return own;
}

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const Particles own = simulate(share_of(MPI_COMM_WORLD), 100, MPI_COMM_WORLD);
    double momentum = 0;
    for (const double velocity : own.velocities) momentum += mass * velocity;
    MPI_Allreduce(MPI_IN_PLACE, &momentum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    int most = static_cast<int>(own.numbers.size());
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    if (rank == 0)
        std::printf("100 steps: at most %d of 1600 particles on a rank, momentum %.9f\n", most,
                    momentum);
    MPI_Finalize();
    return std::abs(momentum - 2) < 1e-12 ? 0 : 1;
}

// Output on 4 ranks:
// 100 steps: at most 511 of 1600 particles on a rank, momentum 2.000000000
