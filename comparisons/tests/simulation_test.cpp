#include "failure.hpp"
#include "partitioner_mpi.hpp"
#include "scene_choice_mpi.hpp"
#include "scene_file/scene_file_mpi.hpp"
#include "scene_mpi.hpp"
#include "simulation_mpi.hpp"

#include <rrcb/error.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>
#include <zoltan.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace comparisons {
namespace {

/// Returns the slope with 22 cells across.
mpm::Scene coarse_slope() {
    mpm::Scene scene = choose_scene("slope", false, MPI_COMM_WORLD);
    mpm::resize_cells(scene, 5);
    return scene;
}

SimulationRun run(const std::optional<mpm::Balancer>& balancer,
                  const mpm::Scene& scene = coarse_slope(), int every = 2) {
    float version = 0;
    Zoltan_Initialize(0, nullptr, &version);
    const SimulationPlan plan{.scene = scene, .num_steps = 6, .every = every, .record_every = 2};
    TimedSimulation simulation(plan, without_weights(balancer), {}, MPI_COMM_WORLD);
    simulation.advance(4);
    simulation.advance(4);
    return simulation.result();
}

int num_ranks() {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

void expect_points_kept(const mpm::Scene& scene) {
    const SimulationRun slabs = run(std::nullopt, scene);
    ASSERT_EQ(slabs.error, "");
    EXPECT_EQ(slabs.balance_s, 0);
    EXPECT_FALSE(slabs.front_m);
    EXPECT_GT(slabs.moved_m, 0);
    for (const char* name :
         {"zoltan-rcb", "root-rcb", "rrcb-sampled", "rrcb", "rrcb-exact", "rrcb-arrays"}) {
        const SimulationRun result = run(make_balancer(read_method(name)), scene);
        ASSERT_EQ(result.error, "") << name;
        EXPECT_NEAR(result.moved_m, slabs.moved_m, 1e-9 * slabs.moved_m) << name;
        EXPECT_EQ(result.num_points, slabs.num_points) << name;
        EXPECT_NEAR(result.mass_kg, slabs.mass_kg, 1e-12 * slabs.mass_kg) << name;
        ASSERT_EQ(result.history.size(), 3U) << name;
        EXPECT_EQ(result.history[1].step, 2) << name;
    }
}

TEST(Simulation, every_balancer_keeps_the_points_and_their_mass) {
    expect_points_kept(coarse_slope());
    mpm::Scene anchor = choose_scene("torpedo_anchor", true, MPI_COMM_WORLD);
    // Without this effect the soil settles at once.
    std::erase_if(anchor.effects,
                  [](const mpm::Effect& effect) { return effect.name == "geostatic"; });
    expect_points_kept(anchor);
}

TEST(Simulation, goes_on_from_a_state_with_the_same_bits) {
    const std::string file = testing::TempDir() + "state_of_simulation_test.mpm";
    mpm::Simulation before(coarse_slope(), MPI_COMM_WORLD);
    for (int step = 0; step < 4; ++step) before.step();
    before.write_state(file);
    const SimulationPlan plan{.scene = coarse_slope(), .num_steps = 2, .state = file};
    TimedSimulation simulation(plan, without_weights({}), {}, MPI_COMM_WORLD);
    simulation.advance(2);
    const SimulationRun after = simulation.result();
    ASSERT_EQ(after.error, "");
    EXPECT_EQ(after.moved_m, run(std::nullopt).moved_m);
    EXPECT_EQ(after.history.front().step, 4);
}

TEST(Simulation, tells_how_far_points_have_come) {
    mpm::Scene scene = choose_scene("torpedo_anchor", true, MPI_COMM_WORLD);
    scene.effects.clear();
    scene.walls = {};
    scene.grid.lower = {-1.2, -3, -1.2};
    scene.grid.spacing = 0.6;
    scene.grid.num_cells = {12, 8, 8};
    scene.bodies.front().velocity = [](const mpm::Vector&) { return mpm::Vector{3000, 0, 4000}; };
    scene.bodies.front().bounds = mpm::everywhere;
    scene.bodies.front().contains = [](const mpm::Vector& at) {
        return at[0] > 0 && at[0] < 3 && at[1] > -1 && at[1] < 0 && at[2] > 0 && at[2] < 1;
    };
    const SimulationRun result = run(std::nullopt, scene);
    ASSERT_EQ(result.error, "");
    const double time = result.history.back().time * 6 / 4;
    ASSERT_GT(time * 5000, 1);
    EXPECT_NEAR(result.moved_m, time * 5000, 1e-9);
    EXPECT_NEAR(result.front_m.value_or(0), 2.85 + time * 3000, 1e-9);
}

TEST(Simulation, snapshots_show_a_scene_at_its_start_middle_and_end) {
    const SimulationPlan plan{.scene = choose_scene("torpedo_anchor", true, MPI_COMM_WORLD),
                              .num_steps = 20};
    const std::vector<Workload> snapshots = scene_snapshots(plan, MPI_COMM_WORLD);
    ASSERT_EQ(snapshots.size(), 3U);
    EXPECT_EQ(snapshots[1].name, "torpedo_anchor-middle");
    EXPECT_EQ(snapshots[0].dimension, 3);
    EXPECT_EQ(snapshots[0].coordinates.size(), snapshots[2].coordinates.size());
    // Soil at rest moves only where the anchor strikes it.
    bool has_moved = snapshots[0].coordinates != snapshots[2].coordinates;
    MPI_Allreduce(MPI_IN_PLACE, &has_moved, 1, MPI_CXX_BOOL, MPI_LOR, MPI_COMM_WORLD);
    EXPECT_TRUE(has_moved);
}

TEST(Simulation, exact_methods_share_the_points_out_to_one_a_level) {
    constexpr double levels = 2;  // levels of the bisection for up to 4 parts
    for (const char* name : {"zoltan-rcb", "root-rcb", "rrcb-exact"}) {
        // Rebalances at every step, because points cross cuts between steps.
        const SimulationRun result = run(make_balancer(read_method(name)), coarse_slope(), 1);
        ASSERT_EQ(result.error, "") << name;
        const double mean = static_cast<double>(result.num_points) / num_ranks();
        for (const LoadRecord& record : result.history) {
            for (const double points : record.points) EXPECT_NEAR(points, mean, levels) << name;
        }
        constexpr double steps = 6;
        EXPECT_NEAR(result.path_points, steps * mean, steps * levels) << name;
        EXPECT_GT(result.step_cost.path_s, 0) << name;
        EXPECT_LE(result.step_cost.path_s, result.step_cost.work_s) << name;
        EXPECT_GE(result.step_cost.path_s * num_ranks(), result.step_cost.work_s) << name;
    }
}

/// Returns slabs that are wider in each rebalance. Notes the share of the points that change owner
/// by testing each point.
mpm::Balancer widening_slabs(std::vector<double>& moved) {
    return [&moved](mpm::Positions positions, MPI_Comm comm) {
        const double width = 20 * std::exp2(static_cast<double>(moved.size()));
        mpm::Decomposition slabs = mpm::slabs({{0, 0, 0}, {width, 1, 0}}, num_ranks());
        std::vector<int> owners(positions.size());
        slabs.owners(positions, owners);
        int rank = 0;
        MPI_Comm_rank(comm, &rank);
        double counts[] = {static_cast<double>(owners.size() - std::ranges::count(owners, rank)),
                           static_cast<double>(owners.size())};
        MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_DOUBLE, MPI_SUM, comm);
        moved.push_back(counts[0] / counts[1]);
        return slabs;
    };
}

SimulationRun run_widening(int record_every, std::vector<double>& moved) {
    const SimulationPlan plan{
        .scene = coarse_slope(), .num_steps = 15, .every = 5, .record_every = record_every};
    TimedSimulation simulation(plan, without_weights(widening_slabs(moved)), {}, MPI_COMM_WORLD);
    simulation.advance(15);
    SimulationRun result = simulation.result();
    EXPECT_EQ(result.error, "");
    return result;
}

double mean_of_records(const SimulationRun& run) {
    double sum = 0;
    for (const LoadRecord& record : run.history) sum += rrcb::imbalance(record.points);
    return sum / static_cast<double>(run.history.size());
}

TEST(Simulation, imbalance_is_that_of_every_step_whatever_is_recorded) {
    std::vector<double> moved;
    const SimulationRun all = run_widening(1, moved);
    ASSERT_EQ(all.history.size(), 15U);
    double worst = 0;
    for (const LoadRecord& record : all.history) {
        worst = std::max(worst, rrcb::imbalance(record.points));
    }
    EXPECT_NEAR(all.mean_imbalance, mean_of_records(all), 1e-12);
    EXPECT_NEAR(all.worst_imbalance, worst, 1e-12);

    moved.clear();
    const SimulationRun aliased = run_widening(2, moved);
    EXPECT_EQ(aliased.mean_imbalance, all.mean_imbalance);
    EXPECT_EQ(aliased.worst_imbalance, all.worst_imbalance);
    if (num_ranks() > 1) {
        EXPECT_GT(std::abs(mean_of_records(aliased) - all.mean_imbalance), 1e-3);
    }
}

TEST(Simulation, tells_what_the_rebalances_moved) {
    std::vector<double> moved;
    const SimulationRun result = run_widening(2, moved);
    ASSERT_EQ(moved.size(), 3U);
    EXPECT_EQ(result.rebalances, 3);
    EXPECT_NEAR(result.moved_fraction, (moved[0] + moved[1] + moved[2]) / 3, 1e-12);
    for (const LoadRecord& record : result.history) {
        EXPECT_EQ(record.moved_fraction, moved[static_cast<std::size_t>(record.step / 5)]);
    }
    if (num_ranks() > 1) {
        EXPECT_GT(moved[1], 0.01);
    }
    const SimulationRun slabs = run(std::nullopt);
    EXPECT_EQ(slabs.rebalances, 0);
    EXPECT_EQ(slabs.moved_fraction, 0);
    EXPECT_EQ(slabs.history.front().moved_fraction, 0);
}

TEST(Simulation, a_controller_rebalances_where_no_interval_is_given) {
    const SimulationPlan plan{.scene = coarse_slope(), .num_steps = 15, .every = 0};
    int num_calls = 0;
    const mpm::Balancer slabs = [&](mpm::Positions positions, MPI_Comm) {
        ++num_calls;
        mpm::Decomposition same = mpm::slabs({{0, -15, 0}, {110, 20, 0}}, num_ranks());
        same.local_owners.resize(positions.size());
        same.owners(positions, same.local_owners);
        return same;
    };
    TimedSimulation simulation(plan, without_weights(slabs), {}, MPI_COMM_WORLD);
    simulation.advance(15);
    const SimulationRun result = simulation.result();
    EXPECT_EQ(result.error, "");
    EXPECT_EQ(result.rebalances, num_calls);
    EXPECT_GE(num_calls, 1);  // the first rebalance is before the first step, whatever the loads
    EXPECT_LE(num_calls, 3);  // each needs two steps to take effect and three to be judged
}

mpm::Decomposition decomposed(const char* method, mpm::Positions positions) {
    return make_balancer(read_method(method)).value()(positions, MPI_COMM_WORLD);
}

TEST(Simulation, a_method_divides_the_same_through_zoltan_and_on_arrays) {
    const mpm::Simulation scene(coarse_slope(), MPI_COMM_WORLD);
    const mpm::Decomposition through_zoltan = decomposed("rrcb", scene.positions());
    const mpm::Decomposition on_arrays = decomposed("rrcb-arrays", scene.positions());
    EXPECT_EQ(through_zoltan.local_owners, on_arrays.local_owners);
    ASSERT_EQ(through_zoltan.boxes.size(), on_arrays.boxes.size());
    for (std::size_t p = 0; p < on_arrays.boxes.size(); ++p) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            EXPECT_EQ(through_zoltan.boxes[p].lower[axis], on_arrays.boxes[p].lower[axis]) << p;
            EXPECT_EQ(through_zoltan.boxes[p].upper[axis], on_arrays.boxes[p].upper[axis]) << p;
        }
    }
    std::vector<int> owners(scene.positions().size());
    through_zoltan.owners(scene.positions(), owners);
    EXPECT_EQ(owners, on_arrays.local_owners);
}

TEST(Simulation, methods_go_through_zoltan_unless_they_are_on_arrays) {
    const std::vector<double> x = {std::nan(""), 1};
    const std::vector<double> y = {1, 2};
    EXPECT_THROW(decomposed("rrcb-arrays", {x, y, {}}), rrcb::Error);
    for (const char* name : {"root-rcb", "rrcb-sampled", "rrcb", "rrcb-exact"}) {
        try {
            decomposed(name, {x, y, {}});
            ADD_FAILURE() << name;
        } catch (const std::runtime_error& failure) {
            EXPECT_STREQ(failure.what(), "Zoltan_LB_Partition returned -1") << name;
        }
    }
}

TEST(Simulation, a_balancer_that_fails_leaves_its_reason) {
    const mpm::Balancer broken = [](mpm::Positions, MPI_Comm) -> mpm::Decomposition {
        throw std::runtime_error("no balance today");
    };
    EXPECT_NE(run(broken).error.find("no balance today"), std::string::npos);
}

}  // namespace
}  // namespace comparisons
