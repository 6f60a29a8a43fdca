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
    std::uint64_t moved = 0;
    while (simulation.time() < 0.5) {
        const double shift = std::sin(40.0 * simulation.time());
        std::vector<double> cuts;
        for (int k = 1; k < size_of(MPI_COMM_WORLD); ++k)
            cuts.push_back(3 + 8 * simulation.time() + shift + spacing * (k - 1));
        moved += simulation.rebalance([&](Positions, MPI_Comm) { return between_cuts(cuts); });
        simulation.step();
    }
    expect_same(totals_of(simulation), start);
    MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    if (size_of(MPI_COMM_WORLD) > 1) {
        EXPECT_GT(moved, static_cast<std::uint64_t>(simulation.num_points()));
    }
}

/// A flying ring or shell, whose rows on the lattice have gaps, and a box of fewer points in a
/// cell.
Scene flying_shell(int dimension) {
    Scene scene = flying_disk();
    scene.dimension = dimension;
    scene.grid.num_cells[2] = dimension == 3 ? 16 : 0;
    const Vector centre{4, 4, dimension == 3 ? 4.0 : 0};
    const auto ball = [centre](double radius) { return ball_region(centre, radius); };
    Body& shell = scene.bodies.front();
    shell.contains = [outer = ball(2), inner = ball(1)](const Vector& at) {
        return outer(at) && !inner(at);
    };
    shell.points_per_cell = {3, 3, 1};
    Body box = shell;
    box.contains = box_region({{10, 3, 3}, {12, 5, 5}});
    box.points_per_cell = {2, 1, 1};
    if (dimension == 2) box.contains = box_region({{10, 3}, {12, 5}});
    scene.bodies.push_back(box);
    return scene;
}

TEST(Displacement, is_the_way_from_the_start_on_whatever_rank_a_point_is) {
    for (const int dimension : {2, 3}) {
        Simulation simulation(flying_shell(dimension), MPI_COMM_WORLD);
        std::vector<std::vector<double>> starts;
        for (const char* axis : {"x", "y", "z"})
            if (simulation.particles().has_column(axis))
                starts.push_back(gathered(simulation, axis, MPI_COMM_WORLD));
        while (simulation.time() < 0.5) simulation.step();
        for (std::size_t a = 0; a < starts.size(); ++a) {
            const char axis = "xyz"[a];
            const auto now = gathered(simulation, {axis}, MPI_COMM_WORLD);
            const auto way =
                gathered(simulation, std::string("displacement_") + axis, MPI_COMM_WORLD);
            for (std::size_t p = 0; p < now.size(); ++p)
                ASSERT_EQ(way[p], now[p] - starts[a][p]) << dimension << axis << p;
        }
        EXPECT_GT(simulation.totals().num_migrated, size_of(MPI_COMM_WORLD) > 1 ? 0 : -1);
    }
}

}  // namespace
}  // namespace mpm::test
