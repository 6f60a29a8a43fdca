#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

struct Totals {
    double mass, momentum_x, momentum_y, num_points;
};

Totals totals_of(const Simulation& simulation) {
    const auto mass = simulation.particles()["mass"];
    const auto across = simulation.particles()["velocity_x"];
    const auto up = simulation.particles()["velocity_y"];
    const auto sum = [&](auto value) { return summed(simulation, MPI_COMM_WORLD, value); };
    return {sum([&](std::size_t p) { return mass[p]; }),
            sum([&](std::size_t p) { return mass[p] * across[p]; }),
            sum([&](std::size_t p) { return mass[p] * up[p]; }),
            sum([](std::size_t) { return 1.0; })};
}

void expect_same(const Totals& now, const Totals& start) {
    EXPECT_EQ(now.num_points, start.num_points);
    EXPECT_NEAR(now.mass / start.mass, 1, 1e-13);
    EXPECT_NEAR(now.momentum_x / start.momentum_x, 1, 1e-12);
    EXPECT_NEAR(now.momentum_y / start.momentum_y, 1, 1e-12);
}

// The first slabs divide the disk where it starts, so every point ends on the last rank.
TEST(FlyingDisk, keeps_mass_and_momentum_through_migration) {
    Simulation simulation(flying_disk(), MPI_COMM_WORLD);
    const Totals start = totals_of(simulation);
    while (simulation.time() < 1.5) simulation.step();
    expect_same(totals_of(simulation), start);
    const bool last = rank_of(MPI_COMM_WORLD) == size_of(MPI_COMM_WORLD) - 1;
    EXPECT_EQ(simulation.particles().size(), last ? simulation.num_points() : 0u);
}

TEST(FlyingDisk, keeps_mass_and_momentum_with_a_rebalance_at_every_step) {
    Simulation simulation(flying_disk(), MPI_COMM_WORLD);
    const Totals start = totals_of(simulation);
    const double spacing = 1.1;
    std::int64_t moved = 0;
    while (simulation.time() < 0.5) {
        const double shift = std::sin(40.0 * simulation.time());
        std::vector<double> cuts;
        for (int k = 1; k < size_of(MPI_COMM_WORLD); ++k)
            cuts.push_back(3 + 8 * simulation.time() + shift + spacing * (k - 1));
        moved += simulation.rebalance([&](Positions, MPI_Comm) { return between_cuts(cuts); })
                     .moved_points;
        simulation.step();
    }
    expect_same(totals_of(simulation), start);
    if (size_of(MPI_COMM_WORLD) > 1) {
        EXPECT_GT(moved, simulation.num_points());
    }
}

}  // namespace
}  // namespace mpm::test
