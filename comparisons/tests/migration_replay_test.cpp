// Points that change rank are counted beside known ones.
#include "drifting_cube_mpi.hpp"
#include "migration_replay_mpi.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace comparisons {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int points_of_rank = 60;
constexpr int step = 2;  ///< points, by which all move to the right
constexpr int num_times = 5;

struct World {
    World() {
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
    }
    int rank = 0;
    int num_ranks = 1;
};

/// Points in a row, between whole numbers.
PointTracks row_of_points() {
    const World world;
    PointTracks tracks(MPI_COMM_WORLD);
    for (int time = 0; time < num_times; ++time) {
        PointTracks::Columns columns;
        for (int i = 0; i < points_of_rank; ++i) {
            columns[0].push_back(world.rank * points_of_rank + i + step * time + 0.5);
            columns[1].push_back(0);
        }
        tracks.add(std::move(columns));
    }
    return tracks;
}

/// Parts of equal width where the row was at first; part p of call number c is on rank p + c
/// `turn`.
class Slabs {
  public:
    explicit Slabs(int turn) : turn_(turn) {}

    mpm::Decomposition operator()(mpm::Positions at, MPI_Comm) {
        const World world;
        mpm::Decomposition made;
        made.boxes.resize(static_cast<std::size_t>(world.num_ranks));
        const auto rank_of = [&, call = *calls_](int part) {
            return (part + call * turn_) % world.num_ranks;
        };
        for (int part = 0; part < world.num_ranks; ++part) {
            const double lower = part == 0 ? -infinity : part * points_of_rank;
            const double upper =
                part + 1 == world.num_ranks ? infinity : (part + 1) * points_of_rank;
            made.boxes[static_cast<std::size_t>(rank_of(part))] = {{lower, 0, 0}, {upper, 0, 0}};
        }
        for (const double x : at.x) {
            const int part = static_cast<int>(x / points_of_rank);
            made.local_owners.push_back(rank_of(std::min(part, world.num_ranks - 1)));
        }
        ++*calls_;
        return made;
    }

  private:
    int turn_;
    std::shared_ptr<int> calls_ = std::make_shared<int>(0);
};

TEST(ReplayMigration, of_cuts_that_stay_moves_what_crosses_them) {
    const World world;
    const PointTracks tracks = row_of_points();
    constexpr int calls = num_times - 1;
    const std::int64_t crossed = calls * step * (world.num_ranks - 1);
    for (const Between between : {Between::follow, Between::stay}) {
        const Migration result = replay_migration(tracks, Slabs(0), between, MPI_COMM_WORLD);
        EXPECT_EQ(result.calls, calls);
        EXPECT_EQ(result.points, points_of_rank * world.num_ranks);
        EXPECT_EQ(result.crossed, crossed);
        EXPECT_EQ(result.moved, between == Between::follow ? 0 : crossed);
        const double gained = world.num_ranks > 1 ? 1.0 * step / points_of_rank : 0;
        EXPECT_NEAR(result.mean_imbalance, 1 + 2.5 * gained, 1e-12);
        EXPECT_NEAR(result.worst_imbalance, 1 + 4 * gained, 1e-12);
    }
}

TEST(ReplayMigration, of_parts_that_change_rank_moves_them_whole) {
    const World world;
    if (world.num_ranks == 1) return;
    const PointTracks tracks = row_of_points();
    const std::int64_t all = (num_times - 1) * points_of_rank * world.num_ranks;
    const std::int64_t crossed = (num_times - 1) * step * (world.num_ranks - 1);
    const auto moved = [&](Between between) {
        const Migration result = replay_migration(tracks, Slabs(1), between, MPI_COMM_WORLD);
        EXPECT_EQ(result.crossed, crossed);
        return result.moved;
    };
    EXPECT_EQ(moved(Between::follow), all);
    // One that crosses a cut gets to the second rank behind its own, which of two is its own.
    EXPECT_EQ(moved(Between::stay), world.num_ranks == 2 ? all - crossed : all);
}

TEST(DriftingCube, moves_each_point_straight_on_between_the_sides) {
    const DriftingCube cube{.num_points = 301, .num_times = 3, .speed = 0.05, .seed = 3};
    const PointTracks tracks = tracks_of(cube, MPI_COMM_WORLD);
    EXPECT_EQ(tracks.num_points(), 301);
    const mpm::Positions first = tracks.positions(0);
    const mpm::Positions next = tracks.positions(1);
    const mpm::Positions last = tracks.positions(2);
    double lowest = 1;
    double highest = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        double length = 0;
        bool is_straight = true;
        for (std::size_t a = 0; a < 3; ++a) {
            const double step_one = next[i][a] - first[i][a];
            const double step_two = last[i][a] - next[i][a];
            length += step_one * step_one;
            is_straight = is_straight && std::abs(step_one - step_two) < 1e-12;
            lowest = std::min(lowest, last[i][a]);
            highest = std::max(highest, last[i][a]);
        }
        EXPECT_LE(std::sqrt(length), 0.05 + 1e-12);
        const bool is_inside = std::ranges::all_of(std::array{0, 1, 2}, [&](int a) {
            const double x = first[i][static_cast<std::size_t>(a)];
            return x > 0.11 && x < 0.89;
        });
        if (!is_inside) continue;
        EXPECT_TRUE(is_straight);
        EXPECT_NEAR(std::sqrt(length), 0.05, 1e-12);
    }
    EXPECT_GE(lowest, 0);
    EXPECT_LE(highest, 1);
}

}  // namespace
}  // namespace comparisons
