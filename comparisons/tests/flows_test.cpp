#include "failure.hpp"
#include "flow.hpp"
#include "follower_mpi.hpp"
#include "ghosts_mpi.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace comparisons {
namespace {

/// Returns a lattice of 40 x 4 points around the origin. Its 40 columns are along x, or, after a
/// clockwise turn by a right angle, along y.
Workload rod(bool has_turned) {
    Workload all{"rod", "", 2, {}, false, {}};
    for (int i = 0; i < 160; ++i) {
        const double along = i % 40 - 19.5;
        const double across = i / 40 - 1.5;
        if (has_turned)
            all.coordinates.insert(all.coordinates.end(), {across, -along});
        else
            all.coordinates.insert(all.coordinates.end(), {along, across});
    }
    return all;
}

struct Turn {
    std::int64_t moved;
    std::int64_t ghosts_near;
    std::int64_t ghosts_wide;

    friend bool operator==(const Turn&, const Turn&) = default;
};

/// Returns the counts of two parts for the turn of the rod.
Turn turn_by(const std::string& policy) {
    Follower follower(policies({policy})[0], 2, MPI_COMM_WORLD);
    EXPECT_EQ(follower.go_on(rod(false)).moved, 0);
    const CallCounts counts = follower.go_on(rod(true));
    EXPECT_EQ(std::ranges::count(follower.parts(), 0), 80);
    EXPECT_GT(counts.messages, 0);
    const auto ghosts = [&](double radius) {
        return GhostCounter(rod(true), {radius, {}}, MPI_COMM_SELF).count(follower.parts(), 2).sum;
    };
    return {counts.moved, ghosts(1.2), ghosts(2.5)};
}

TEST(Follower, counts_moves_and_ghosts_of_a_rod_that_turns) {
    // The cut crosses four rows. On each side one column is near it, and two are within 2.5. The
    // end at negative x was below the cut and is above it after the turn. All points therefore
    // change their part, unless the parts are renumbered.
    EXPECT_EQ(turn_by("fresh"), (Turn{160, 8, 16}));
    EXPECT_EQ(turn_by("fresh + remap"), (Turn{0, 8, 16}));
    // With kept axes the cut is along the rod, with two columns on each side.
    EXPECT_EQ(turn_by("kept axes"), (Turn{80, 80, 160}));
}

TEST(Flow, has_thousands_of_finite_particles_that_move_and_is_the_same_again) {
    for (const std::string& name : flow_names()) {
        SCOPED_TRACE(name);
        const Flow flow = make_flow(name);
        EXPECT_GE(flow.num_points, 6000U);
        EXPECT_LE(flow.num_points, 10'000U);
        EXPECT_GE(flow.num_calls, 60U);
        EXPECT_LE(flow.num_calls, 120U);
        const std::vector<double> first = flow.positions(0);
        const std::vector<double> later = flow.positions(4);
        EXPECT_EQ(first.size(), flow.num_points * static_cast<std::size_t>(flow.dimension));
        EXPECT_EQ(later.size(), first.size());
        EXPECT_NE(later, first);
        EXPECT_TRUE(std::ranges::all_of(later, [](double x) { return std::isfinite(x); }));
        EXPECT_EQ(make_flow(name).positions(4), later);
    }
    EXPECT_THROW(make_flow("flaw"), Failure);
    EXPECT_THROW(policies({"stale"}), Failure);
}

}  // namespace
}  // namespace comparisons
