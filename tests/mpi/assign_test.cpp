// Parts of positions anywhere, with errors on all ranks alike.
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/error.hpp>

namespace rrcb {
namespace {

/// The same tree on every rank, with zeros, infinities and both signs, in groups of 1 to 3 parts.
Cuts random_cuts(int dimension, int num_parts) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::mt19937_64 engine(static_cast<unsigned>(num_parts));
    Cuts cuts{dimension, num_parts, {}, {1 + num_parts % 3, num_parts % 2 == 0}};
    for (int k = 1; k < num_parts; ++k) {
        Cut cut;
        cut.axis = static_cast<std::int32_t>(engine() % static_cast<unsigned>(dimension));
        cut.divides = static_cast<std::int32_t>(engine() % 2);
        for (double& x : cut.at)
            x = engine() % 4 == 0 ? -infinity : static_cast<double>(engine() % 9) - 4;
        cuts.tree.push_back(cut);
    }
    return cuts;
}

/// Expects the parts of positions of this rank on and off the cuts; every third rank has none.
void expect_located(const Cuts& cuts) {
    std::mt19937_64 engine(static_cast<unsigned>(100 + rank()));
    std::vector<double> coordinates;
    const int count = rank() % 3 == 2 ? 0 : 40 * rank() + 10;
    for (int i = 0; i < count * cuts.dimension; ++i)
        coordinates.push_back(static_cast<double>(engine() % 19) / 2 - 4.5);
    const Points points(coordinates, cuts.dimension);
    const std::vector<Part> parts = assign(cuts, points, MPI_COMM_WORLD);
    ASSERT_EQ(parts.size(), points.count);
    for (LocalIndex i = 0; i < points.count; ++i)
        EXPECT_EQ(parts[i], part_of(cuts, points.position(i)));
}

TEST(AssignTogether, finds_the_parts_of_positions_anywhere) {
    for (const int dimension : {1, 2, 3})
        for (const int num_parts : {1, 2, num_ranks() + 1, 300})
            expect_located(random_cuts(dimension, num_parts));
}

/// Expects an Error with this text on every rank, after which the next call works.
void expect_refusal(const std::string& text, const Cuts& cuts, const Points& points) {
    test::expect_same_error([&] { assign(cuts, points, MPI_COMM_WORLD); }, text);
    expect_located(random_cuts(2, 9));
}

TEST(AssignTogether, refuses_what_one_rank_gives_wrong_on_all) {
    const Cuts right = random_cuts(2, 2 * num_ranks() + 5);
    const std::string last = "rank " + std::to_string(num_ranks() - 1) + ": ";
    const std::vector<double> x{0, is_last_rank() ? std::nan("") : 1, 0};
    const std::span<const double> some(x);
    expect_refusal(last + "coordinate of point 0 on axis 1 is NaN", right,
                   Points(some.first(2), 2));
    const Points none(some.first(0), 2);
    expect_refusal(last + "positions must have the dimension", right,
                   Points(some.first(0), is_last_rank() ? 3 : 2));
    const auto spoiled = [&](auto&& spoil) {
        Cuts cuts = right;
        if (is_last_rank()) spoil(cuts);
        return cuts;
    };
    expect_refusal(last + "the tree must hold", spoiled([](Cuts& cuts) { cuts.tree.pop_back(); }),
                   none);
    expect_refusal(last + "a cut has an axis", spoiled([](Cuts& cuts) { cuts.tree[0].axis = 2; }),
                   none);
    if (num_ranks() == 1) return;
    expect_refusal("the tree of cuts differs",
                   spoiled([](Cuts& cuts) { cuts.tree.front().at.fill(0.123); }), none);
}

TEST(AssignTogether, refuses_cuts_that_are_no_tree) {
    const Points none(std::span<const double>(), 2);
    for (const int dimension : {-1, 0, 4, 9})
        expect_refusal("cuts must have 1, 2 or 3 dimensions", {dimension, 1, {}}, none);
    expect_refusal("the tree must hold", {2, 0, {}}, none);
    expect_refusal("the tree must hold", {2, 5, {}}, none);
}

}  // namespace
}  // namespace rrcb
