#include "../../tests/support/ranks.hpp"
#include "phase_log_mpi.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace comparisons {
namespace {

void work(double seconds) {
    const double end = processor_seconds() + seconds;
    while (processor_seconds() < end) {
    }
}

TEST(PhaseLog, charges_messages_collectives_and_bytes_to_the_network) {
    const Network network{2, 100};
    Traffic traffic;
    traffic.messages = 5;
    traffic.bytes = 300;
    EXPECT_DOUBLE_EQ(network_seconds(traffic, 8, network), 5 * 2 + 3);
    // Two of the messages are collectives, and one communicator is made. Each of these takes three
    // rounds.
    traffic.collectives = 2;
    traffic.communicators = 1;
    EXPECT_DOUBLE_EQ(network_seconds(traffic, 8, network), (3 + 3 * 3) * 2 + 3);
    EXPECT_DOUBLE_EQ(network_seconds(traffic, 5, network), (3 + 3 * 3) * 2 + 3);
    EXPECT_DOUBLE_EQ(network_seconds(traffic, 1, network), 3 * 2 + 3);
}

TEST(PhaseLog, charges_one_latency_for_a_collective_that_overlaps) {
    const Network network{2, 100};
    Traffic traffic;
    traffic.messages = traffic.collectives = 1;
    EXPECT_DOUBLE_EQ(network_seconds(traffic, 8, network), 3 * 2);
    EXPECT_DOUBLE_EQ(network_seconds(traffic, 8, network, Waits::in_the_next), 2);
    EXPECT_DOUBLE_EQ(network_seconds(traffic, 1, network, Waits::in_the_next), 0);
}

TEST(PhaseLog, shows_the_work_of_rank_0) {
    constexpr double busy_s = 0.03;
    PhaseLog log;
    log.record([&] {
        if (rrcb::test::rank() == 0) work(busy_s);
    });
    const PathCost cost = log.cost(MPI_COMM_WORLD);
    EXPECT_GE(cost.root_s, busy_s);
    EXPECT_LE(cost.root_s, cost.path_s);
}

TEST(PhaseLog, adds_the_slowest_rank_of_each_phase) {
    constexpr double busy_s = 0.03;
    const int n = rrcb::test::num_ranks();
    PhaseLog log;
    for (int phase = 0; phase < n; ++phase) {
        log.record([&] {
            if (phase == rrcb::test::rank()) work(busy_s);
            MPI_Barrier(MPI_COMM_WORLD);
        });
    }
    // In each phase one rank works while the others wait.
    const PathCost cost = log.cost(MPI_COMM_WORLD);
    EXPECT_GE(cost.path_s, n * busy_s);
    EXPECT_GE(cost.work_s, n * busy_s);
    EXPECT_GE(cost.work_s, cost.path_s);
    EXPECT_LT(cost.work_s, 1.5 * n * busy_s);
    const int rounds = n > 2 ? 2 : n - 1;
    EXPECT_DOUBLE_EQ(cost.network_s, n * rounds * Network{}.latency_s);
}

// In each of three phases every rank takes part in a reduction of two doubles, in and out.
TEST(PhaseLog, counts_messages_and_bytes_of_all_ranks) {
    const int n = rrcb::test::num_ranks();
    PhaseLog log;
    for (int phase = 0; phase < 3; ++phase)
        log.record([] {
            double numbers[2] = {};
            MPI_Allreduce(MPI_IN_PLACE, numbers, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        });
    const PathCost cost = log.cost(MPI_COMM_WORLD);
    EXPECT_EQ(cost.messages, 3 * n);
    EXPECT_EQ(cost.bytes, 3 * n * 2 * 16);
}

TEST(PhaseLog, ends_a_phase_that_fails) {
    PhaseLog log;
    EXPECT_THROW(log.record([] { throw std::runtime_error("no"); }), std::runtime_error);
    start_counting_traffic();
    stop_counting_traffic();
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(stop_counting_traffic().messages, 0);
    EXPECT_GE(log.cost(MPI_COMM_WORLD).path_s, 0);
}

}  // namespace
}  // namespace comparisons
