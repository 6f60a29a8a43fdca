// Parts of positions by cuts that are spread over the ranks, beside those by the whole tree.
#include "../support/clouds.hpp"
#include "../support/same_error.hpp"
#include "partial_trees.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/error.hpp>

namespace rrcb {
namespace {

using test::known_here;
using test::random_cuts;

/// Positions of this rank on and off the cuts; every third rank has none.
std::vector<double> positions_here(int dimension, int seed) {
    std::mt19937_64 engine(static_cast<unsigned>(100 * seed + rank()));
    std::vector<double> coordinates;
    const int count = rank() % 3 == 2 ? 0 : 40 * rank() + 10;
    for (int i = 0; i < count * dimension; ++i)
        coordinates.push_back(static_cast<double>(engine() % 19) / 2 - 4.5);
    return coordinates;
}

void expect_located(const Cuts& whole, const Cuts& known, int seed) {
    const std::vector<double> coordinates = positions_here(whole.dimension, seed);
    const Points points = interleaved_points(coordinates, whole.dimension);
    const std::vector<Part> parts = assign_all(known, points, MPI_COMM_WORLD);
    ASSERT_EQ(parts.size(), points.count);
    for (LocalIndex i = 0; i < points.count; ++i)
        EXPECT_EQ(parts[i], part_of(whole, points.position(i)));
}

TEST(AssignTogether, finds_the_parts_of_positions_anywhere) {
    for (const int dimension : {1, 2, 3})
        for (const int num_parts : {2, num_ranks() + 1, 3 * num_ranks(), 64, 300}) {
            SCOPED_TRACE(num_parts);
            const Cuts whole = random_cuts(dimension, num_parts);
            expect_located(whole, known_here(whole), dimension);
            expect_located(whole, known_here(whole, {0, num_parts / 2}), 7);
            expect_located(whole, whole, 3);
        }
}

TEST(AssignTogether, finds_the_parts_of_a_tree_of_many_tiers) {
    const int num_parts = 40000;
    const Cuts whole = test::planes(num_parts);
    std::mt19937_64 engine(static_cast<unsigned>(rank()));
    std::vector<double> x;
    for (int i = 0; i < 200; ++i) x.push_back(test::uniform(engine, 0, num_parts));
    const std::vector<Part> parts =
        assign_all(known_here(whole), interleaved_points(x, 1), MPI_COMM_WORLD);
    for (std::size_t i = 0; i < x.size(); ++i) EXPECT_EQ(parts[i], static_cast<Part>(x[i]));
}

/// Expects an Error with this text on every rank, after which the next call works.
void expect_refusal(const std::string& text, const Cuts& cuts, const Points& points) {
    test::expect_same_error([&] { assign_all(cuts, points, MPI_COMM_WORLD); }, text);
    const Cuts whole = random_cuts(2, 9);
    expect_located(whole, known_here(whole), 1);
}

TEST(AssignTogether, refuses_what_one_rank_gives_wrong_on_all) {
    const Cuts whole = random_cuts(2, 2 * num_ranks() + 5);
    const Cuts right = known_here(whole);
    const std::string last = "rank " + std::to_string(num_ranks() - 1) + ": ";
    const std::vector<double> x{0, is_last_rank() ? std::nan("") : 1, 0};
    const std::span<const double> some(x);
    expect_refusal(last + "coordinate of point 0 on axis 1 is NaN", right,
                   interleaved_points(some.first(2), 2));
    expect_refusal(last + "positions must have the dimension", right,
                   interleaved_points(std::span<const double>(), is_last_rank() ? 3 : 2));
    Cuts cuts = right;
    if (is_last_rank()) {
        cuts.nodes.pop_back();
        cuts.tree.pop_back();
    }
    expect_refusal(last + "a cut is missing", cuts,
                   interleaved_points(std::span<const double>(), 2));
    if (num_ranks() == 1) return;
    expect_refusal("whether the tree is whole differs", is_last_rank() ? whole : right,
                   interleaved_points(std::span<const double>(), 2));
    Cuts other = whole;
    if (is_last_rank()) other.tree.front().at.fill(0.123);
    expect_refusal("the tree of cuts differs", other,
                   interleaved_points(std::span<const double>(), 2));
}

}  // namespace
}  // namespace rrcb
