// Loads that are counted afterwards beside those of ranks whose points really moved.
#include "interval_recording_mpi.hpp"
#include "part_loads_mpi.hpp"

#include <gtest/gtest.h>
#include <mpm/decomposition.hpp>

#include <string>
#include <vector>

namespace comparisons {
namespace {

int num_ranks() {
    int size = 1;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    return size;
}

std::vector<double> points_of_ranks(const MovingPoints& points) {
    std::vector<double> all(static_cast<std::size_t>(num_ranks()));
    const auto mine = static_cast<double>(points.particles().size());
    MPI_Allgather(&mine, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, MPI_COMM_WORLD);
    return all;
}

/// Slabs of another width than those of the start.
mpm::Decomposition narrow_slabs(mpm::Positions, MPI_Comm) {
    return mpm::slabs({{0, 30, 0}, {1, 90, 0}}, num_ranks());
}

TEST(PointTracks, count_what_the_ranks_have) {
    constexpr int num_points = 901;
    const DriftingCloud cloud{num_points, 8, 5};
    const std::unique_ptr<MovingPoints> points = cloud_points(cloud, MPI_COMM_WORLD);
    PointTracks tracks(MPI_COMM_WORLD);
    std::vector<std::vector<double>> counted;
    for (int time = 0; time < 8; ++time) {
        tracks.add(*points);
        if (time == 2) points->rebalance(narrow_slabs);
        counted.push_back(points_of_ranks(*points));
        points->step();
    }
    const auto made_at_2 = tracks.loads([] { return mpm::Balancer(narrow_slabs); }, 3);
    for (int time = 2; time < 8; ++time) {
        for (int part = 0; part < num_ranks(); ++part) {
            const double mean = static_cast<double>(num_points) / num_ranks();
            EXPECT_DOUBLE_EQ(
                made_at_2->load(2, time, part) * mean,
                counted[static_cast<std::size_t>(time)][static_cast<std::size_t>(part)])
                << time << ", part " << part;
        }
    }
    if (num_ranks() > 1) {
        EXPECT_NE(counted[2], counted[7]);
    }
}

TEST(RecordIntervals, balances_the_points_anew_and_keeps_them_all) {
    const DriftingCloud cloud{1200, 60, 0.5};
    const std::unique_ptr<MovingPoints> points = cloud_points(cloud, MPI_COMM_WORLD);
    const std::vector<Method> methods = read_methods("zoltan-rcb,rrcb-arrays");
    const RecordedScene recorded =
        record_intervals(*points, methods, {"cloud", 11, 2, 2, 1e-6}, MPI_COMM_WORLD);
    ASSERT_EQ(recorded.map.methods.size(), 2U);
    EXPECT_EQ(recorded.seconds_per_point, 1e-6);
    for (const MappedMethod& method : recorded.map.methods) {
        const LoadHistory& history = method.history;
        EXPECT_EQ(history.num_steps, 60);
        EXPECT_LE(history.load(30, 30).heaviest, 1.03) << method.method;
        EXPECT_GE(history.load(0, 59).heaviest, history.load(59, 59).heaviest);
        EXPECT_GT(history.cost(0), 0);
        EXPECT_GT(method.cost_s, 0);
        EXPECT_LE(method.call_s, method.cost_s);
    }
    double count = 0;
    for (const double mine : points_of_ranks(*points)) count += mine;
    EXPECT_EQ(count, 1200);
}

}  // namespace
}  // namespace comparisons
