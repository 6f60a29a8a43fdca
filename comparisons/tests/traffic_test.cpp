#include "traffic.hpp"

#include "../../tests/support/ranks.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <array>

namespace comparisons {
namespace {

/// Returns the totals over all ranks of the traffic of `communicate`.
template <typename Communicate>
std::array<std::int64_t, 3> totals(Communicate&& communicate) {
    start_counting_traffic();
    communicate();
    const Traffic mine = stop_counting_traffic();
    std::array<std::int64_t, 3> sums{mine.messages, mine.bytes, mine.root_bytes_in};
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), 3, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return sums;
}

using Expected = std::array<std::int64_t, 3>;

TEST(Traffic, counts_a_ring_of_messages_once_each) {
    const int n = rrcb::test::num_ranks();
    const auto ring = [&] {
        const std::array<double, 5> out{};
        std::array<double, 5> in{};
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Irecv(in.data(), 5, MPI_DOUBLE, (rrcb::test::rank() + n - 1) % n, 0, MPI_COMM_WORLD,
                  &request);
        MPI_Send(out.data(), 5, MPI_DOUBLE, (rrcb::test::rank() + 1) % n, 0, MPI_COMM_WORLD);
        MPI_Wait(&request, MPI_STATUS_IGNORE);
    };
    EXPECT_EQ(totals(ring), (Expected{n, 40 * n, 40}));
}

TEST(Traffic, counts_messages_into_the_root_whatever_the_communicator) {
    const int n = rrcb::test::num_ranks();
    // Rank 0 of the world is the last rank of the reversed communicator.
    MPI_Comm reversed = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, 0, -rrcb::test::rank(), &reversed);
    const auto send_to_last = [&] {
        const std::array<int, 3> out{};
        std::array<int, 3> in{};
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Isend(out.data(), 3, MPI_INT, n - 1, 0, reversed, &request);
        for (int r = 0; rrcb::test::rank() == 0 && r < n; ++r) {
            MPI_Recv(in.data(), 3, MPI_INT, r, 0, reversed, MPI_STATUS_IGNORE);
        }
        MPI_Wait(&request, MPI_STATUS_IGNORE);
    };
    EXPECT_EQ(totals(send_to_last), (Expected{n, 12 * n, 12 * n}));
    MPI_Comm_free(&reversed);
}

TEST(Traffic, counts_sendrecv_and_leaves_out_the_null_rank) {
    const int n = rrcb::test::num_ranks();
    const auto shift_up = [&] {
        const char out = 'a';
        char in = 'b';
        const int to = rrcb::test::rank() + 1 < n ? rrcb::test::rank() + 1 : MPI_PROC_NULL;
        const int from = rrcb::test::rank() > 0 ? rrcb::test::rank() - 1 : MPI_PROC_NULL;
        MPI_Sendrecv(&out, 1, MPI_CHAR, to, 0, &in, 1, MPI_CHAR, from, 0, MPI_COMM_WORLD,
                     MPI_STATUS_IGNORE);
    };
    EXPECT_EQ(totals(shift_up), (Expected{n - 1, n - 1, 0}));
}

TEST(Traffic, counts_what_ranks_hand_in_and_get_out_of_collectives) {
    const int n = rrcb::test::num_ranks();
    std::array<double, 2> pair{};
    std::vector<double> all(2 * static_cast<std::size_t>(n));
    EXPECT_EQ(totals([&] { MPI_Barrier(MPI_COMM_WORLD); }), (Expected{n, 0, 0}));
    // The root passes in 16 bytes, and every other rank gets 16 bytes.
    EXPECT_EQ(totals([&] { MPI_Bcast(pair.data(), 2, MPI_DOUBLE, 0, MPI_COMM_WORLD); }),
              (Expected{n, 16 * n, 0}));
    // Every rank passes in 16 bytes, and the root gets 16 n bytes.
    EXPECT_EQ(totals([&] {
                  MPI_Gather(pair.data(), 2, MPI_DOUBLE, all.data(), 2, MPI_DOUBLE, 0,
                             MPI_COMM_WORLD);
              }),
              (Expected{n, 32 * n, 16 * n}));
    EXPECT_EQ(totals([&] {
                  MPI_Allreduce(MPI_IN_PLACE, pair.data(), 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
              }),
              (Expected{n, 32 * n, 16}));
    EXPECT_EQ(totals([&] {
                  std::vector<double> out(all.size());
                  MPI_Alltoall(out.data(), 2, MPI_DOUBLE, all.data(), 2, MPI_DOUBLE,
                               MPI_COMM_WORLD);
              }),
              (Expected{n, 32 * n * n, 16 * n}));
    // Every rank passes in 8 n bytes and gets 8 bytes.
    EXPECT_EQ(totals([&] {
                  double block = 0;
                  MPI_Reduce_scatter_block(all.data(), &block, 1, MPI_DOUBLE, MPI_SUM,
                                           MPI_COMM_WORLD);
              }),
              (Expected{n, 8 * n * n + 8 * n, 8}));
}

TEST(Traffic, counts_unequal_pieces) {
    const int n = rrcb::test::num_ranks();
    // Rank r passes in r + 1 bytes, which is n (n + 1) / 2 in all.
    std::vector<int> counts;
    std::vector<int> starts;
    for (int r = 0; r < n; ++r) {
        starts.push_back(r * (r + 1) / 2);
        counts.push_back(r + 1);
    }
    const int sum = n * (n + 1) / 2;
    const std::vector<char> mine(static_cast<std::size_t>(n));
    std::vector<char> all(static_cast<std::size_t>(sum));
    EXPECT_EQ(totals([&] {
                  MPI_Gatherv(mine.data(), rrcb::test::rank() + 1, MPI_CHAR, all.data(),
                              counts.data(), starts.data(), MPI_CHAR, 0, MPI_COMM_WORLD);
              }),
              (Expected{n, 2 * sum, sum}));
    EXPECT_EQ(totals([&] {
                  MPI_Allgatherv(mine.data(), rrcb::test::rank() + 1, MPI_CHAR, all.data(),
                                 counts.data(), starts.data(), MPI_CHAR, MPI_COMM_WORLD);
              }),
              (Expected{n, sum + n * sum, sum}));
}

TEST(Traffic, counts_collectives_and_communicators_apart) {
    MPI_Barrier(MPI_COMM_WORLD);
    start_counting_traffic();
    MPI_Barrier(MPI_COMM_WORLD);
    MPI_Comm halves = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rrcb::test::rank() % 2, 0, &halves);
    MPI_Barrier(halves);
    const int out = rrcb::test::rank();
    int in = -1;
    MPI_Sendrecv(&out, 1, MPI_INT, out, 0, &in, 1, MPI_INT, out, 0, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
    const Traffic traffic = stop_counting_traffic();
    MPI_Comm_free(&halves);
    EXPECT_EQ(traffic.messages, 3);
    EXPECT_EQ(traffic.collectives, 2);
    EXPECT_EQ(traffic.communicators, 1);
}

TEST(Traffic, tells_waiting_from_working) {
    constexpr double busy_s = 0.05;
    const auto work = [] {
        const double end = processor_seconds() + busy_s;
        while (processor_seconds() < end) {
        }
    };
    start_counting_traffic();
    const double start = processor_seconds();
    if (rrcb::test::rank() == 0) work();
    MPI_Barrier(MPI_COMM_WORLD);
    const double elapsed = processor_seconds() - start;
    const double work_s = elapsed - stop_counting_traffic().seconds_in_mpi;
    if (rrcb::test::rank() == 0) {
        EXPECT_GE(work_s, busy_s);
    } else {
        EXPECT_LT(work_s, busy_s / 2);
    }
}

TEST(Traffic, counts_a_loop_that_polls_as_waiting) {
    constexpr double busy_s = 0.02;
    const auto work = [] {
        const double end = processor_seconds() + busy_s;
        while (processor_seconds() < end) {
        }
    };
    MPI_Request request = MPI_REQUEST_NULL;
    int value = 0;
    int is_done = 1;
    const auto measured = [&] {
        start_counting_traffic();
        const double start = processor_seconds();
        MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        work();
        MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        const double elapsed = processor_seconds() - start;
        return elapsed - stop_counting_traffic().seconds_in_mpi;
    };
    EXPECT_GE(measured(), busy_s / 2) << "no request: the rank works between two calls";
    MPI_Irecv(&value, 1, MPI_INT, rrcb::test::rank(), 0, MPI_COMM_WORLD, &request);
    EXPECT_LT(measured(), busy_s / 2);
    MPI_Cancel(&request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
}

}  // namespace
}  // namespace comparisons
