// The search of one level by itself: where it ends, and that a failure on one rank ends it on all.
#include "search_level.hpp"

#include <gtest/gtest.h>

#include <new>

namespace rrcb {
namespace {

using test::Level;
using test::points_per_rank;

TEST(LevelSearch, halves_the_points_of_all_ranks) {
    Level level;
    Participant self{MPI_COMM_WORLD};
    EXPECT_GE(level.run(self), 1);
    EXPECT_EQ(level.search().stage, CutSearch::done);
    EXPECT_NEAR(level.below(), 0.5 * points_per_rank * test::num_ranks(), 0.5);
    EXPECT_EQ(level.below(), level.search().below);
}

TEST(LevelSearch, ends_on_all_ranks_as_soon_as_one_has_failed) {
    for (const bool at_root : {true, false}) {
        Level level;
        Participant self{MPI_COMM_WORLD};
        const int failing = at_root ? 0 : test::num_ranks() - 1;
        if (test::rank() == failing) self.attempt([] { throw std::bad_alloc(); });
        try {
            level.run(self);
            ADD_FAILURE() << "nothing was thrown";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::out_of_memory);
        }
        EXPECT_EQ(level.search().stage, CutSearch::abandoned);
        EXPECT_EQ(level.search().upper, 1) << "nothing is decided by counts that lack a rank";
    }
}

}  // namespace
}  // namespace rrcb
