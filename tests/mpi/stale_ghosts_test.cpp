// Ghosts from before a transfer.
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"
#include "slabs.hpp"

#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>
#include <rrcb/plan.hpp>

namespace rrcb {
namespace {

const std::string stale = "the points were transferred since these ghosts were found";

/// Points of this rank go as many ranks further.
Plan shift_by(int ranks, std::size_t count) {
    const std::vector<Part> parts(count, (rank() + ranks + num_ranks()) % num_ranks());
    return plan(parts, num_ranks(), MPI_COMM_WORLD);
}

/// Points in the slab of this rank, near its faces, and their ghosts.
struct Slab {
    std::vector<double> x{rank() + 0.1, 0, rank() + 0.9, 0};
    GhostPlan near = ghost_plan(test::slabs(), Points(x, 2), MPI_COMM_WORLD, {.cutoff = 0.2});

    std::vector<double> fetched() const { return fetch(near, column(x, 2), MPI_COMM_WORLD); }
};

void expect_stale(const Slab& slab) {
    test::expect_same_error([&] { slab.fetched(); }, stale);
    std::size_t num_ghosts = 0;
    for (const RankCount& from : slab.near.receive) num_ghosts += from.count;
    const std::vector<double> of_ghosts(2 * num_ghosts);
    test::expect_same_error(
        [&] {
            static_cast<void>(
                accumulate(slab.near, column(of_ghosts, 2), column(slab.x, 2), MPI_COMM_WORLD));
        },
        stale);
}

TEST(StaleGhosts, are_refused_on_all_ranks_after_a_transfer_of_as_many_points) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    Slab slab;
    slab.x = transfer(shift_by(1, 2), column(slab.x, 2), MPI_COMM_WORLD);
    expect_stale(slab);
    slab.near = unstamped(slab.near);
    EXPECT_NO_THROW(slab.fetched());
    // Found again they are good.
    EXPECT_NO_THROW(Slab{}.fetched());
}

TEST(StaleGhosts, are_refused_although_one_rank_has_other_points_only) {
    if (num_ranks() < 3) GTEST_SKIP() << "needs three ranks";
    Slab slab;
    const int to = rank() == 0 ? 1 : rank() == 1 ? 0 : rank();
    const Plan swapped = plan(std::vector<Part>(2, to), num_ranks(), MPI_COMM_WORLD);
    slab.x = transfer(swapped, column(slab.x, 2), MPI_COMM_WORLD);
    expect_stale(slab);
}

TEST(StaleGhosts, are_not_those_of_a_plan_that_was_made_before) {
    std::vector<double> x{rank() + 0.1, 0, rank() + 0.9, 0};
    const std::vector<int> masses(2);
    const Plan moves = shift_by(1, 2);
    x = transfer(moves, column(x, 2), MPI_COMM_WORLD);
    const Slab slab;
    static_cast<void>(transfer(moves, masses, MPI_COMM_WORLD));
    EXPECT_NO_THROW(slab.fetched());
}

TEST(StaleGhosts, are_good_again_once_their_points_are_back) {
    std::vector<double> x{rank() + 0.1, 0, rank() + 0.9, 0};
    const Plan there = shift_by(1, 2);
    const Plan back = shift_by(-1, 2);
    x = transfer(there, column(x, 2), MPI_COMM_WORLD);
    const Slab slab;
    for (int step = 0; step < 3; ++step) {
        x = transfer(back, column(x, 2), MPI_COMM_WORLD);
        x = transfer(there, column(x, 2), MPI_COMM_WORLD);
        EXPECT_NO_THROW(slab.fetched());
    }
}

TEST(StaleGhosts, are_not_those_of_other_points_or_of_points_that_stay) {
    const Slab slab;
    static_cast<void>(transfer(shift_by(0, 2), column(slab.x, 2), MPI_COMM_WORLD));
    EXPECT_NO_THROW(slab.fetched());
    // As many on all ranks but one.
    const std::vector<int> others(is_last_rank() ? 3 : 2);
    static_cast<void>(transfer(shift_by(1, others.size()), others, MPI_COMM_WORLD));
    EXPECT_NO_THROW(slab.fetched());
}

TEST(StaleGhosts, are_recognized_after_many_other_transfers) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    Slab slab;
    for (std::size_t k = 0; k < 12; ++k) {
        const std::vector<int> others(10 + k);
        static_cast<void>(transfer(shift_by(1, others.size()), others, MPI_COMM_WORLD));
    }
    EXPECT_NO_THROW(slab.fetched());
    slab.x = transfer(shift_by(1, 2), column(slab.x, 2), MPI_COMM_WORLD);
    expect_stale(slab);
}

}  // namespace
}  // namespace rrcb
