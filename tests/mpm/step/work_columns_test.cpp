// Columns of the work of ranks: parts of points add up to them, and a cost model that is told the
// seconds by them evens out the dam break. Seconds are counts here, not a clock's.
#include "balancers_mpi.hpp"
#include "variations.hpp"

#include <rrcb/experimental/cost.hpp>

#include <mpm/simulation.hpp>

namespace mpm::test {
namespace {

Scene dam_break() {
    return shipped("dam_break", 0.1);
}

TEST(WorkColumns, are_the_sums_of_the_parts_of_points) {
    Simulation simulation(dam_break(), MPI_COMM_WORLD);
    simulation.rebalance(rrcb_balancer());
    simulation.step();
    const std::vector<double> rows = simulation.point_columns();
    const std::vector<double> columns = simulation.work_columns();
    ASSERT_EQ(columns.size(), 4U);
    ASSERT_EQ(rows.size(), 4 * simulation.particles().size());
    std::vector<double> sums(4);
    for (std::size_t i = 0; i < rows.size(); ++i) sums[i % 4] += rows[i];
    EXPECT_EQ(sums[0], columns[0]);
    // The points have moved since the runs were counted.
    EXPECT_NEAR(sums[1], columns[1], 0.2 * columns[1]);
    EXPECT_NEAR(sums[2], columns[2], 1e-9 * columns[2]);
    EXPECT_EQ(sums[3], 0);
    EXPECT_EQ(columns[3] > 0, size_of(MPI_COMM_WORLD) > 1);
}

/// A point takes 100 ns, a run 200, a node 2 us, a shared one 50 ns. Real nodes are cheaper by far,
/// and even points are even time within 2 %.
double seconds_of(const std::vector<double>& columns) {
    return 1e-9 * (100 * columns[0] + 200 * columns[1] + 2000 * columns[2] + 50 * columns[3]);
}

double imbalance_of(double seconds) {
    double most = seconds;
    double sum = seconds;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return most * size_of(MPI_COMM_WORLD) / sum;
}

/// Imbalance of time after a number of rebalances, 50 steps apart.
double imbalance_after(int num_rebalances, bool learns) {
    Simulation simulation(dam_break(), MPI_COMM_WORLD);
    rrcb::experimental::CostModel model(MPI_COMM_WORLD, 4);
    const mpm::Balancer balancer = rrcb_balancer({}, [&] {
        return model.weights(learns && model.uses_costs() ? simulation.point_columns()
                                                          : std::vector<double>());
    });
    double imbalance = 0;
    for (int step = 0; step <= 50 * num_rebalances; ++step) {
        if (step % 50 == 0) simulation.rebalance(balancer);
        simulation.step();
        model.step(seconds_of(simulation.work_columns()), simulation.work_columns());
        imbalance = imbalance_of(seconds_of(simulation.work_columns()));
    }
    return imbalance;
}

TEST(WorkColumns, let_a_cost_model_even_out_the_dam_break) {
    if (size_of(MPI_COMM_WORLD) < 4) GTEST_SKIP() << "there is little to even out";
    EXPECT_GE(imbalance_after(6, false), 1.07);
    EXPECT_LE(imbalance_after(6, true), 1.04);
}

}  // namespace
}  // namespace mpm::test
