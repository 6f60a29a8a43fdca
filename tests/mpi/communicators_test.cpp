// Communicators that the library cannot use.
#include "../support/same_error.hpp"
#include "clouds.hpp"
#include "ranks.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

/// Every collective function of the interface throws the same on every rank.
void expect_refusal(MPI_Comm comm, const std::string& text) {
    const std::vector<double> x{0, 1};
    const Points points(x, 1);
    const std::vector<Part> parts(2);
    const std::vector<RankRange> ranks(1);
    Cuts cuts;
    cuts.dimension = 1;
    cuts.num_parts = 1;
    const std::vector<std::function<void()>> calls = {
        [&] { balance(points, comm); },
        [&] { balance(points, comm, {}, cuts); },
        [&] { plan(parts, 1, comm); },
        [&] { remap(parts, ranks, comm); },
        [&] { remap(parts, parts, ranks, comm); },
        [&] { part_weights(points, parts, 1, comm); },
        [&] { moved_fraction(points, parts, 1, comm); },
        [&] { Controller controller(comm); },
        [&] { assign(cuts, points, comm); },
    };
    for (const auto& call : calls) {
        test::expect_same_error([&] { call(); }, text);
    }
    EXPECT_EQ(plan(parts, 1, MPI_COMM_WORLD).export_indices.size(), 0u);
}

TEST(Communicators, that_are_null_are_refused) {
    expect_refusal(MPI_COMM_NULL,
                   "MPI_COMM_NULL has no ranks; give a communicator with this rank in it");
}

TEST(Communicators, of_two_groups_are_refused) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const int group = rank() % 2;
    MPI_Comm mine = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, group, 0, &mine);
    MPI_Comm both = MPI_COMM_NULL;
    MPI_Intercomm_create(mine, 0, MPI_COMM_WORLD, 1 - group, 0, &both);
    expect_refusal(both, "an intercommunicator has two groups; merge them by MPI_Intercomm_merge");
    MPI_Comm merged = MPI_COMM_NULL;
    MPI_Intercomm_merge(both, 0, &merged);
    const std::vector<double> x{0, 1};
    EXPECT_EQ(balance(Points(x, 1), merged).report.details.num_points, 2 * num_ranks());
    MPI_Comm_free(&merged);
    MPI_Comm_free(&both);
    MPI_Comm_free(&mine);
}

/// Plans of the points of all ranks, and the calls that use them with a communicator.
struct Plans {
    std::vector<double> x = test::uniform_cloud(50, 1, static_cast<unsigned>(rank() + 1));
    Balance made = balance(Points(x, 1), MPI_COMM_WORLD);
    Plan moves = plan(made, MPI_COMM_WORLD);
    std::vector<double> here = transfer(moves, x, MPI_COMM_WORLD);
    GhostPlan near = near_on(MPI_COMM_WORLD);
    Groups bonds = groups(Points(x, 1), std::vector<std::uint64_t>(x.size(), 1), MPI_COMM_WORLD);
    std::vector<double> of_ghosts = fetch(near, here, MPI_COMM_WORLD);

    GhostPlan near_on(MPI_Comm comm) const {
        return ghost_plan(made.cuts, Points(here, 1), comm, {.cutoff = 0.1});
    }

    std::vector<std::function<void()>> calls(MPI_Comm comm) const {
        return {
            [=, this] { EXPECT_EQ(plan(made, comm).export_ranks, moves.export_ranks); },
            [=, this] { EXPECT_EQ(transfer(moves, x, comm), here); },
            [=, this] { EXPECT_EQ(near_on(comm).send_indices, near.send_indices); },
            [=, this] { EXPECT_EQ(fetch(near, here, comm), of_ghosts); },
            [=, this] { EXPECT_EQ(accumulate(near, of_ghosts, here, comm).size(), here.size()); },
            [=, this] { EXPECT_EQ(group_sums(bonds, x, comm).size(), bonds.weights.size()); }};
    }
};

void expect_refusals(const Plans& plans, MPI_Comm comm) {
    for (const auto& call : plans.calls(comm)) {
        test::expect_same_error([&] { call(); }, "belongs to other ranks");
    }
}

TEST(Communicators, of_other_ranks_than_those_of_the_balance_are_refused) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const Plans plans;
    expect_refusals(plans, MPI_COMM_SELF);
    for (const auto& [color, key] : {std::pair{rank() % 2, 0}, {0, -rank()}}) {
        MPI_Comm other = MPI_COMM_NULL;
        MPI_Comm_split(MPI_COMM_WORLD, color, key, &other);
        expect_refusals(plans, other);
        MPI_Comm_free(&other);
    }
}

TEST(Communicators, of_the_same_ranks_in_the_same_order_are_accepted) {
    Plans plans;
    MPI_Comm same = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, 0, rank(), &same);
    for (const auto& call : plans.calls(same)) call();
    MPI_Comm_free(&same);
    // Cuts that are to be used on other ranks.
    plans.made.cuts = unstamped(plans.made.cuts);
    EXPECT_EQ(plan(plans.made, MPI_COMM_SELF).export_ranks.size(), 0u);
}

}  // namespace
}  // namespace rrcb
