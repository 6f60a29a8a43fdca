// Neighbours by the boxes of any balancer: who owns a point on faces, in overlaps and in gaps.
#include "../support/common.hpp"
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const MPI_Comm world = MPI_COMM_WORLD;

/// A box that is bounded along the first axis only.
Box slab(double lower, double upper) {
    return {{lower, -infinity, -infinity}, {upper, infinity, infinity}};
}

/// The box of rank r is from r to r + 1, and longer by `more` on either side.
std::vector<Box> slabs(double more = 0) {
    std::vector<Box> boxes;
    for (int r = 0; r < num_ranks(); ++r) boxes.push_back(slab(r - more, r + 1 + more));
    return boxes;
}

/// Rank 0 has a point at each of these places. Returns where they are after a call of migrate().
std::vector<int> owners_after(Neighbours& neighbours, const std::vector<double>& places) {
    std::vector<double> x;
    std::vector<int> ids;
    for (std::size_t i = 0; rank() == 0 && i < places.size(); ++i) {
        x.insert(x.end(), {places[i], 0.5});
        ids.push_back(static_cast<int>(i));
    }
    neighbours.migrate(column(x, 2), ids);
    std::vector<int> owners(places.size(), 0);
    for (const int id : ids) owners[static_cast<std::size_t>(id)] += rank() + 1;
    MPI_Allreduce(MPI_IN_PLACE, owners.data(), static_cast<int>(owners.size()), MPI_INT, MPI_SUM,
                  world);
    for (int& owner : owners) --owner;
    return owners;
}

/// Returns the Error that a rank gets from steps with these points on rank 0.
std::string text_of_steps(Neighbours& neighbours, const std::vector<double>& places) {
    std::vector<double> x;
    for (const double place : places)
        if (rank() == 0) x.insert(x.end(), {place, 0.5});
    try {
        for (int step = 0; step <= num_ranks(); ++step) neighbours.migrate(column(x, 2));
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(BoxNeighbours, keep_points_on_their_faces) {
    if (num_ranks() < 3) GTEST_SKIP() << "a box is to have two neighbours";
    Neighbours neighbours(slabs(), 2, world, {.travel = 2});
    // A point on the face of ranks 1 and 2, which was on neither, goes to the first of them.
    EXPECT_EQ(owners_after(neighbours, {0, 1, 1.5, 2, 2.5}), (std::vector<int>{0, 0, 1, 1, 2}));
}

TEST(BoxNeighbours, keep_points_where_boxes_overlap) {
    if (num_ranks() < 3) GTEST_SKIP() << "a box is to have two neighbours";
    Neighbours neighbours(slabs(0.25), 2, world, {.cutoff = 0.125, .travel = 2});
    EXPECT_EQ(owners_after(neighbours, {1.2, 1.26, 2.2}), (std::vector<int>{0, 1, 1}));
    // The box of rank r + 1 begins at r + 0.75, the box of rank r - 1 ends at r + 0.25.
    std::vector<double> x{rank() + 0.5, 0, rank() + 0.65, 0, rank() + 0.8, 0}, ghosts;
    neighbours.find_ghosts(column(x, 2));
    neighbours.fetch(ghosts_of(ghosts), column(x, 2));
    EXPECT_EQ(ghosts, rank() > 0 ? (std::vector<double>{rank() - 0.35, 0, rank() - 1 + 0.8, 0})
                                 : std::vector<double>{});
}

TEST(BoxNeighbours, may_be_within_others) {
    if (num_ranks() < 2) GTEST_SKIP() << "two boxes are needed";
    std::vector<Box> boxes(static_cast<std::size_t>(num_ranks()));
    boxes[0] = {{0, 0, 0}, {8, 8, 0}};
    boxes[1] = {{4, 4, 0}, {4, 4, 0}};
    Neighbours neighbours(boxes, 2, world, {.cutoff = 1, .travel = 1});
    std::vector<double> x, ghosts;
    if (rank() == 0) x = {4.5, 4.5, 2, 2, 4, 4};
    neighbours.migrate(column(x, 2));
    EXPECT_EQ(x.size(), rank() == 0 ? 6U : 0U);
    neighbours.find_ghosts(column(x, 2));
    neighbours.fetch(ghosts_of(ghosts), column(x, 2));
    EXPECT_EQ(ghosts, rank() == 1 ? (std::vector<double>{4.5, 4.5, 4, 4}) : std::vector<double>{});
}

TEST(BoxNeighbours, may_be_empty_and_get_errors_nevertheless) {
    std::vector<Box> boxes(static_cast<std::size_t>(num_ranks()));
    boxes.front() = slab(-infinity, 0.5);
    boxes.back() = num_ranks() > 1 ? slab(0.5, infinity) : slab(-infinity, infinity);
    Neighbours neighbours(boxes, 2, world, {.travel = 1});
    EXPECT_EQ(owners_after(neighbours, {0.25, 0.75}), (std::vector<int>{0, num_ranks() - 1}));
    std::string text;
    try {
        if (rank() == 0) neighbours.fail("enough");
        text = text_of_steps(neighbours, {});
    } catch (const Error& error) {
        text = error.what();
    }
    EXPECT_EQ(text, "rank 0: enough");
}

TEST(BoxNeighbours, refuse_points_in_gaps) {
    Neighbours neighbours(slabs(-0.125), 2, world, {.travel = 1});
    const std::string text = text_of_steps(neighbours, {0.5, 1});
    EXPECT_NE(text.find("rank 0: point 1 (the first is 0) at (1, 0.5) is in none of the boxes"),
              std::string::npos)
        << text;
}

TEST(BoxNeighbours, refuse_far_jumps) {
    if (num_ranks() < 4) GTEST_SKIP() << "a box is to be no neighbour";
    Neighbours neighbours(slabs(), 2, world, {.travel = 1});
    const std::string text = text_of_steps(neighbours, {3.5});
    EXPECT_NE(text.find("now belongs to rank 3, which is no neighbour"), std::string::npos) << text;
}

TEST(BoxNeighbours, may_be_several_of_a_rank_or_one_of_all) {
    if (num_ranks() < 2) GTEST_SKIP() << "two boxes are needed";
    const std::vector<Box> boxes{slab(-infinity, 1), slab(1, 2), slab(2, infinity)};
    const std::vector<RankRange> ranks{{0, 1}, {num_ranks() - 1, 1}, {0, 1}};
    Neighbours neighbours(boxes, 2, world, {.travel = 1, .ranks_of_parts = ranks});
    EXPECT_EQ(owners_after(neighbours, {0, 1.5, 3, 2}),
              (std::vector<int>{0, num_ranks() - 1, 0, 0}));
    const std::vector<Box> whole{slab(-infinity, infinity)};
    Neighbours shared(whole, 2, world, {.travel = 1});
    EXPECT_EQ(owners_after(shared, {0, 7}), (std::vector<int>{0, 0}));
}

TEST(BoxNeighbours, refuse_boxes_that_are_none) {
    const auto expect_refused = [](const std::vector<Box>& boxes, int dimension,
                                   const std::string& words) {
        test::expect_same_error(
            [&] { Neighbours(boxes, dimension, world, NeighbourOptions{.travel = 1}); }, words);
    };
    expect_refused({}, 2, "give a box for each part");
    expect_refused(slabs(), 4, "dimension must be 1, 2 or 3");
    std::vector<Box> boxes = slabs();
    boxes.back().upper[1] = std::nan("");
    expect_refused(boxes, 2, "bounds of boxes must not be NaN");
    Neighbours(boxes, 1, world, NeighbourOptions{.travel = 1});
    if (num_ranks() > 1) expect_refused(slabs(rank()), 2, "the boxes");
}

}  // namespace
}  // namespace rrcb
