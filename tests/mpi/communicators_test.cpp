// Communicators that the library cannot use.
#include "ranks.hpp"

#include <rrcb/rrcb.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace rrcb {
namespace {

/// Every collective function of the interface throws the same on every rank.
void expect_refusal(MPI_Comm comm, const std::string& text) {
    const std::vector<double> x{0, 1};
    const Points points = interleaved_points(x, 1);
    const std::vector<Part> parts(2);
    const std::vector<RankRange> ranks(1);
    Cuts cuts;
    cuts.dimension = 1;
    cuts.num_parts = 1;
    const std::vector<std::function<void()>> calls = {
        [&] { balance(points, {}, comm); },
        [&] { rebalance(points, {}, cuts, comm); },
        [&] { plan(parts, 1, comm); },
        [&] { remap(parts, ranks, comm); },
        [&] { remap(parts, parts, ranks, comm); },
        [&] { part_weights(points, parts, 1, comm); },
        [&] { moved_fraction(points, parts, 1, comm); },
        [&] { Controller controller(comm); },
        [&] { gather_cuts(cuts, comm); },
        [&] { assign_all(cuts, points, comm); },
    };
    for (const auto& call : calls) {
        try {
            call();
            ADD_FAILURE() << "nothing was thrown";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
            EXPECT_EQ(error.what(), text);
        }
    }
    EXPECT_EQ(plan(parts, 1, MPI_COMM_WORLD).export_indices.size(), 0u);
}

TEST(Communicators, that_are_null_are_refused) {
    expect_refusal(MPI_COMM_NULL,
                   "MPI_COMM_NULL has no ranks; give a communicator with this rank in it");
}

TEST(Communicators, of_two_groups_are_refused) {
    if (test::num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const int group = test::rank() % 2;
    MPI_Comm mine = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, group, 0, &mine);
    MPI_Comm both = MPI_COMM_NULL;
    MPI_Intercomm_create(mine, 0, MPI_COMM_WORLD, 1 - group, 0, &both);
    expect_refusal(both, "an intercommunicator has two groups; merge them by MPI_Intercomm_merge");
    MPI_Comm merged = MPI_COMM_NULL;
    MPI_Intercomm_merge(both, 0, &merged);
    const std::vector<double> x{0, 1};
    EXPECT_EQ(balance(interleaved_points(x, 1), {}, merged).report.details.num_points,
              2 * test::num_ranks());
    MPI_Comm_free(&merged);
    MPI_Comm_free(&both);
    MPI_Comm_free(&mine);
}

}  // namespace
}  // namespace rrcb
