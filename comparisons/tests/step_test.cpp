#include "../../tests/support/ranks.hpp"
#include "counts_mpi.hpp"
#include "far_jump_mpi.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>
#include <string_view>
#include <vector>

namespace comparisons {
namespace {

/// Returns the sum over the stages of a step that moves points, or of one that keeps points and
/// ghosts.
StageCounts total(std::string_view arm, const Flow& flow, bool keeps) {
    const std::vector<std::string> names = stage_names(make_arm(arm, flow));
    const std::vector<StageCounts> counts = count(arm, flow, 4);
    StageCounts sum;
    for (std::size_t k = 0; k < names.size(); ++k) {
        if (names[k].starts_with("kept ") != keeps) continue;
        sum.collectives += counts[k].collectives;
        sum.messages += counts[k].messages;
        sum.allocations += counts[k].allocations;
    }
    return sum;
}

/// Returns the mean number of neighbours of a rank in a box of cubes.
double mean_neighbours(int dimension) {
    if (rrcb::test::num_ranks() == 4) return 3;
    return dimension == 2 ? 4 : 7;
}

class Step : public testing::TestWithParam<int> {
  protected:
    Flow flow_{GetParam(), 1000, MPI_COMM_WORLD};
};

INSTANTIATE_TEST_SUITE_P(dimensions, Step, testing::Values(2, 3));

TEST_P(Step, moves_the_same_points_and_ghosts_and_adds_the_same_forces_in_each_arm) {
    SameResults results;
    std::size_t ghosts = 0;
    for (const std::string name : {"loop", "neighbours", "by-hand"})
        run(make_arm(name, flow_), flow_, 4,
            {[](std::size_t, const std::function<void()>& call) { call(); },
             [&](int step, const Particles& particles) {
                 EXPECT_NO_THROW(results.check(name, step, particles));
                 ghosts += particles.ghost_ids.size();
             }});
    EXPECT_GT(ghosts, 0U);
}

TEST_P(Step, with_neighbours_sends_three_messages_to_each_and_two_if_nothing_moves) {
    const StageCounts moves = total("neighbours", flow_, false);
    EXPECT_EQ(moves.collectives, 0);
    EXPECT_EQ(moves.messages, 3 * mean_neighbours(GetParam()));
    EXPECT_LE(moves.allocations, 4);
    const StageCounts keeps = total("neighbours", flow_, true);
    EXPECT_EQ(keeps.collectives, 0);
    EXPECT_EQ(keeps.messages, 2 * mean_neighbours(GetParam()));
    EXPECT_EQ(keeps.allocations, 0);
}

TEST_P(Step, by_hand_sends_three_messages_to_each_neighbour_and_two_if_nothing_moves) {
    const StageCounts moves = total("by-hand", flow_, false);
    EXPECT_EQ(moves.collectives, 0);
    EXPECT_EQ(moves.messages, 3 * mean_neighbours(GetParam()));
    EXPECT_LE(moves.allocations, 2);
    const StageCounts keeps = total("by-hand", flow_, true);
    EXPECT_EQ(keeps.collectives, 0);
    EXPECT_EQ(keeps.messages, 2 * mean_neighbours(GetParam()));
    EXPECT_EQ(keeps.allocations, 0);
}

TEST_P(Step, of_calls_for_points_that_go_anywhere_takes_six_collectives) {
    const StageCounts moves = total("loop", flow_, false);
    EXPECT_LE(moves.collectives, 6);
    EXPECT_LE(moves.messages, 37);
    // The limit includes the allocations of the exchange that a plan keeps from its first call on.
    EXPECT_LE(moves.allocations, 260);
    const StageCounts keeps = total("loop", flow_, true);
    EXPECT_LE(keeps.collectives, 2);
    EXPECT_LE(keeps.messages, 20);
    EXPECT_LE(keeps.allocations, 70);
}

TEST_P(Step, of_a_point_that_passes_all_neighbours_fails_on_every_rank_and_loses_no_point) {
    // If all ranks are neighbours, the point arrives.
    const bool passes = mean_neighbours(GetParam()) < rrcb::test::num_ranks() - 1;
    std::size_t points = 0;
    for (const Discovery& found : jump_far(flow_)) {
        points += found.points;
        EXPECT_EQ(found.is_known, passes);
        if (!passes) continue;
        EXPECT_LE(found.calls, 3);  // the diameter of the graph of neighbours
    }
    EXPECT_EQ(points, 1000U * static_cast<std::size_t>(rrcb::test::num_ranks()));
}

}  // namespace
}  // namespace comparisons
