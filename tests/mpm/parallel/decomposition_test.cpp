#include "support.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <stdexcept>

namespace mpm::test {
namespace {

constexpr int num_steps = 150;
constexpr double round_off = 1e-12;

struct Displacements {
    std::vector<double> x, y;
};

Displacements displacements_of(const Simulation& simulation, MPI_Comm comm) {
    return {gathered(simulation, "displacement_x", comm),
            gathered(simulation, "displacement_y", comm)};
}

using BeforeStep = std::function<void(Simulation&)>;

Displacements run(const Scene& scene, MPI_Comm comm, const BeforeStep& before_step = {}) {
    Simulation simulation(scene, comm);
    for (int step = 0; step < num_steps; ++step) {
        if (before_step) before_step(simulation);
        simulation.step();
    }
    return displacements_of(simulation, comm);
}

/// The slope, already failing: most of its points yield within the steps of the test.
Scene soft_slope() {
    Scene scene = coarse_slope();
    Parameters& soil = scene.materials.front().parameters;
    soil["cohesion"] = 1e3;
    soil["tension_cut_off"] = 1e3;
    return scene;
}

void expect_same(const Displacements& a, const Displacements& b) {
    EXPECT_LT(relative_difference(a.x, b.x), round_off);
    EXPECT_LT(relative_difference(a.y, b.y), round_off);
}

/// Cuts that wander over the slope and leave some ranks outside it now and then.
std::vector<double> wandering_cuts(std::int64_t step) {
    std::vector<double> cuts;
    for (int k = 1; k < size_of(MPI_COMM_WORLD); ++k)
        cuts.push_back(60 * std::sin(0.3 * static_cast<double>(step)) + 33.0 * k - 5);
    return cuts;
}

TEST(Decomposition, gives_the_displacements_of_a_serial_run) {
    expect_same(run(soft_slope(), MPI_COMM_WORLD), run(soft_slope(), MPI_COMM_SELF));
}

TEST(Decomposition, repeats_to_the_bit) {
    const Displacements first = run(soft_slope(), MPI_COMM_WORLD);
    const Displacements second = run(soft_slope(), MPI_COMM_WORLD);
    EXPECT_EQ(first.x, second.x);
    EXPECT_EQ(first.y, second.y);
}

TEST(Decomposition, balanced_at_every_step_equals_never) {
    const Displacements balanced = run(soft_slope(), MPI_COMM_WORLD, [](Simulation& simulation) {
        simulation.rebalance([&](Positions, MPI_Comm) {
            return between_cuts(wandering_cuts(simulation.step_count()));
        });
    });
    expect_same(balanced, run(soft_slope(), MPI_COMM_WORLD));
}

TEST(Decomposition, may_put_several_ranks_into_one_cell) {
    std::vector<double> cuts;
    for (int k = 1; k < size_of(MPI_COMM_WORLD); ++k) cuts.push_back(35.1 + 0.9 * k);
    const Displacements narrow = run(soft_slope(), MPI_COMM_WORLD, [&](Simulation& simulation) {
        if (simulation.step_count() == 0)
            simulation.rebalance([&](Positions, MPI_Comm) { return between_cuts(cuts); });
    });
    expect_same(narrow, run(soft_slope(), MPI_COMM_SELF));
}

TEST(Decomposition, moves_every_point_to_one_rank_and_back) {
    constexpr double far_left = -1e3;
    Simulation simulation(soft_slope(), MPI_COMM_WORLD);
    const int num_ranks = size_of(MPI_COMM_WORLD);
    const std::vector<double> outside(static_cast<std::size_t>(num_ranks - 1), far_left);
    const auto to_last = [&](Positions, MPI_Comm) { return between_cuts(outside); };
    const std::size_t held = simulation.particles().size();
    const bool is_last = rank_of(MPI_COMM_WORLD) == num_ranks - 1;
    EXPECT_EQ(simulation.rebalance(to_last), is_last ? 0 : held);
    EXPECT_EQ(simulation.particles().size(), is_last ? simulation.num_points() : 0u);
    EXPECT_EQ(simulation.rebalance(to_last), 0u);
    for (int step = 0; step < 20; ++step) simulation.step();
    simulation.rebalance([&](Positions, MPI_Comm) { return between_cuts(wandering_cuts(1)); });
    for (int step = 0; step < 20; ++step) simulation.step();

    Simulation serial(soft_slope(), MPI_COMM_SELF);
    for (int step = 0; step < 40; ++step) serial.step();
    expect_same(displacements_of(simulation, MPI_COMM_WORLD),
                displacements_of(serial, MPI_COMM_SELF));
}

/// A column of the lattice: 5 points to a cell of 5 m, hence at 0.5 m and every metre on.
double lattice_column(int k) {
    return soft_slope().grid.lower[0] + (20 * k + 2 + 0.5) * (soft_slope().grid.spacing / 5);
}

Displacements run_with_ties(bool up, std::int64_t& num_ties) {
    std::vector<double> cuts;
    for (int k = 1; k < size_of(MPI_COMM_WORLD); ++k) cuts.push_back(lattice_column(k));
    return run(soft_slope(), MPI_COMM_WORLD, [&](Simulation& simulation) {
        if (simulation.step_count() > 0) return;
        simulation.rebalance([&](Positions, MPI_Comm) { return between_cuts(cuts, up); });
        for (const double x : simulation.positions().x) num_ties += std::ranges::count(cuts, x);
        MPI_Allreduce(MPI_IN_PLACE, &num_ties, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    });
}

TEST(Decomposition, lets_points_on_a_cut_go_to_either_side) {
    std::int64_t num_up = 0, num_down = 0;
    const Displacements up = run_with_ties(true, num_up);
    const Displacements down = run_with_ties(false, num_down);
    if (size_of(MPI_COMM_WORLD) > 1) {
        EXPECT_GT(num_up, 10);
    }
    EXPECT_EQ(num_up, num_down);
    expect_same(up, down);
    expect_same(up, run(soft_slope(), MPI_COMM_SELF));
}

TEST(Decomposition, takes_owners_from_a_balancer_that_names_them) {
    const double cut = lattice_column(1);
    std::vector<double> cuts(static_cast<std::size_t>(size_of(MPI_COMM_WORLD) - 1), 1e3);
    if (!cuts.empty()) cuts.front() = cut;
    // Ties are dealt out in turn, which no look-up by position can repeat.
    const Balancer dealing = [&](Positions positions, MPI_Comm) {
        Decomposition decomposition = between_cuts(cuts);
        decomposition.local_owners.resize(positions.x.size());
        decomposition.owners(positions, decomposition.local_owners);
        for (std::size_t p = 0; p < positions.x.size() && !cuts.empty(); ++p)
            if (positions.x[p] == cut) decomposition.local_owners[p] = static_cast<int>(p % 2);
        return decomposition;
    };
    const Displacements dealt = run(soft_slope(), MPI_COMM_WORLD, [&](Simulation& simulation) {
        if (simulation.step_count() == 0) simulation.rebalance(dealing);
    });
    expect_same(dealt, run(soft_slope(), MPI_COMM_SELF));
}

TEST(Decomposition, refuses_too_few_boxes_on_every_rank) {
    Simulation simulation(coarse_slope(), MPI_COMM_WORLD);
    const std::vector<double> cuts(static_cast<std::size_t>(size_of(MPI_COMM_WORLD)), 5.0);
    EXPECT_THROW(simulation.rebalance([&](Positions, MPI_Comm) { return between_cuts(cuts); }),
                 std::runtime_error);
}

TEST(Decomposition, refuses_an_owner_that_one_rank_gets_wrong_on_every_rank) {
    Simulation simulation(coarse_slope(), MPI_COMM_WORLD);
    const int wrong = size_of(MPI_COMM_WORLD);
    EXPECT_THROW(simulation.rebalance([&](Positions positions, MPI_Comm) {
        Decomposition decomposition = simulation.decomposition();
        if (rank_of(MPI_COMM_WORLD) == 0)
            decomposition.local_owners.assign(positions.x.size(), wrong);
        return decomposition;
    }),
                 std::runtime_error);
    simulation.step();
}

TEST(Decomposition, shows_a_point_without_a_position_to_every_rank) {
    Simulation simulation(coarse_slope(), MPI_COMM_WORLD);
    simulation.step();
    // The ends of a row of ranks are as far from each other as ranks get.
    Particles& points = const_cast<Particles&>(simulation.particles());
    if (rank_of(MPI_COMM_WORLD) == 0)
        points.data(points.find_column("velocity_x"))[0] = std::nan("");
    // The tests trap operations with NaN.
    std::fenv_t traps;
    std::feholdexcept(&traps);
    std::string text;
    try {
        for (int step = 0; step < 2 * size_of(MPI_COMM_WORLD); ++step) simulation.step();
    } catch (const std::runtime_error& error) {
        text = error.what();
    }
    std::fesetenv(&traps);
    EXPECT_NE(text.find("has no finite position: x = "), std::string::npos) << text;
    EXPECT_NE(text.find("lower the Courant number"), std::string::npos) << text;
}

TEST(Slabs, divide_the_longest_extent_equally) {
    const Decomposition wide = slabs({{0, 0}, {8, 2}}, 4);
    EXPECT_EQ(wide.boxes[1].lower[0], 2);
    EXPECT_EQ(wide.boxes[1].upper[0], 4);
    EXPECT_TRUE(std::isinf(wide.boxes[0].lower[0]));
    EXPECT_TRUE(std::isinf(wide.boxes[3].upper[0]));
    const Decomposition tall = slabs({{0, 0}, {2, 9}}, 3);
    EXPECT_EQ(tall.boxes[1].lower[1], 3);
    const std::vector<double> x{1, 1, 1}, y{2.5, 3.5, 100};
    std::vector<int> owners(3);
    tall.owners({x, y}, owners);
    EXPECT_EQ(owners, (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace mpm::test
