// The meeting of a call costs no messages beyond those that the call needs: counted below the
// library, over all ranks.
#include "../support/common.hpp"
#include "mpi_layer.hpp"
#include "ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <bit>

namespace rrcb {
namespace {

const MPI_Comm world = MPI_COMM_WORLD;

/// Collective calls, and messages between two ranks, sent or received, of all ranks.
using Counts = std::array<long, 2>;

Counts counts_of(const std::function<void()>& call) {
    call();
    mpi_layer::fail_call(0);
    mpi_layer::fail_message(0);
    call();
    Counts counts{mpi_layer::counted_calls(), mpi_layer::counted_messages()};
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), 2, MPI_LONG, MPI_SUM, world);
    return counts;
}

/// Calls with the collective calls that each takes besides its meeting, which is an agreement along
/// the tree of ranks: a message from each rank except rank 0, and a broadcast.
class MessageCounts : public testing::Test {
  protected:
    std::vector<double> x{0.1 + rank(), 0.2, 0.3 + rank(), 0.4, 0.7 * rank(), 0.1};
    Points points = Points(x, 2);
    Balance made = balance(points, world);

    void expect_agreement(long num_collectives, const std::function<void()>& call) {
        const auto [collectives, messages] = counts_of(call);
        EXPECT_EQ(collectives, num_ranks() * (1 + num_collectives));
        EXPECT_EQ(messages, 2 * (num_ranks() - 1));
    }
};

TEST_F(MessageCounts, of_a_meeting_that_agrees_are_those_of_a_reduction) {
    expect_agreement(1, [&] { part_weights(points, made, world); });
    expect_agreement(1, [&] { moved_fraction(points, made, world); });
    expect_agreement(0, [&] { assign(made.cuts, points, world); });
    expect_agreement(0, [&] { balance(points, world, {}, made.cuts); });
    expect_agreement(2, [&] { Controller{world}; });
}

TEST_F(MessageCounts, of_a_butterfly_that_meets_are_its_own_and_one_agreement_follows) {
    const std::vector<Part> parts(points.count, rank());
    const auto [collectives, messages] = counts_of([&] { plan(parts, num_ranks(), world); });
    EXPECT_EQ(collectives, num_ranks());
    // On powers of two each rank sends to one of the other half in each halving.
    const long num_steps = std::bit_width(static_cast<unsigned>(num_ranks())) - 1;
    EXPECT_EQ(messages, 2 * num_steps * num_ranks());
}

}  // namespace
}  // namespace rrcb
