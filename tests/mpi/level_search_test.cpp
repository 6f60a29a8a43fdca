// The search of one level by itself: where it ends, and that a failure on one rank ends it on all.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"
#include "refinement/level_search_mpi.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <new>

namespace rrcb {
namespace {

constexpr LocalIndex points_per_rank = 3000;

/// A level of one node, which is to be halved across the first axis.
class Level {
  public:
    Level() : coordinates_(test::uniform_cloud(points_per_rank, 2, seed())) {
        const Points points = interleaved_points(coordinates_, 2);
        const SupportMesh mesh = make_support_mesh(bounding_box(points), 2, 4);
        points_ = sort_by_cell(bin_by_cell(points, mesh));
        const double weight = static_cast<double>(points_per_rank) * test::num_ranks();
        node_ = {{0, 0, 2}, cell_fragments(points_), weight};
        rule_.part_sizes = sizes_;
        rule_.common_weight = 1;
        rule_.is_exact = true;
        CutSearch start;
        start.cut.at.fill(-std::numeric_limits<double>::infinity());
        start.upper = 1;
        start.num_axes = 2;
        start.quantum = quantum_for(weight);
        level_.add(node_, start, {}, points_);
    }

    int run(Participant& self) { return level_.run(rule_, self); }
    const CutSearch& search() const { return level_.search(0); }

    /// Points of all ranks below the cut found.
    double below() const {
        double below = 0;
        for (LocalIndex i = 0; i < points_.count(); ++i)
            below += is_above(search().cut, points_.position(i), 2) ? 0 : 1;
        MPI_Allreduce(MPI_IN_PLACE, &below, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        return below;
    }

  private:
    static unsigned seed() { return static_cast<unsigned>(test::rank()) + 1; }

    std::vector<double> coordinates_;
    std::vector<double> sizes_{1, 1};
    SortedPoints points_;
    Node node_;
    TargetRule rule_;
    LevelSearch level_{1, {}, 2, test::rank() == 0};
};

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
