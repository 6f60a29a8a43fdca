#include "estimate/kept_tree.hpp"

#include "arithmetic/position_order.hpp"
#include "cuts/tree.hpp"
#include "passes/summary.hpp"

#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Positions = std::vector<Vector>;

/// What each rank holds.
using Distribution = std::vector<Positions>;

PointSummary extent_of(const Positions& positions, int dimension) {
    std::vector<double> coordinates;
    for (const Vector& x : positions)
        coordinates.insert(coordinates.end(), x.begin(), x.begin() + dimension);
    return summary_of(Points(coordinates, dimension));
}

Options options_for(std::size_t num_parts) {
    Options options;
    options.num_parts = static_cast<int>(num_parts);
    options.part_sizes.assign(num_parts, 1);
    options.refine = Refine::tolerance;
    options.expert.axes.order = AxisOrder::longest();
    return options;
}

/// Only the axes matter.
Cuts across(std::vector<int> axes, int dimension) {
    Cuts cuts{dimension, static_cast<int>(axes.size()) + 1, {}};
    for (const int axis : axes) cuts.tree.push_back({axis, 0, {}});
    return cuts;
}

std::optional<KeptTree> read(const Distribution& held, const Cuts& estimate,
                             const Options& options) {
    std::vector<PointSummary> extents;
    for (const Positions& positions : held)
        extents.push_back(extent_of(positions, estimate.dimension));
    return read_kept_tree(extents, estimate, options);
}

std::optional<KeptTree> read(const Distribution& held, const Cuts& estimate) {
    return read(held, estimate, options_for(held.size()));
}

void expect_cuts_give_every_rank_its_part(const Distribution& held, const KeptTree& current) {
    for (std::size_t rank = 0; rank < held.size(); ++rank)
        for (const Vector& x : held[rank])
            EXPECT_EQ(part_of(current.cuts, x), current.parts[rank]) << "rank " << rank;
}

/// Different positions, on a lattice: many share a coordinate.
Positions lattice(int width, int dimension) {
    Positions positions;
    for (int k = 0; k < (dimension == 3 ? width : 1); ++k)
        for (int j = 0; j < (dimension > 1 ? width : 1); ++j)
            for (int i = 0; i < width; ++i) positions.push_back({double(i), double(j), double(k)});
    return positions;
}

Box box_of(const Positions& positions) {
    Box box;
    for (const Vector& x : positions) {
        for (std::size_t a = 0; a < 3; ++a) {
            box.lower[a] = std::min(box.lower[a], x[a]);
            box.upper[a] = std::max(box.upper[a], x[a]);
        }
    }
    return box;
}

/// Divides positions at random, each side getting a point a part, across the axes that `axis_of`
/// tells by the box of what is divided.
template <class AxisOf>
void divide(Positions positions, Descent at, int dimension, AxisOf&& axis_of,
            std::mt19937_64& engine, Cuts& cuts, Distribution& held) {
    if (at.is_part()) {
        held[static_cast<std::size_t>(at.first_part)] = positions;
        return;
    }
    const int axis = axis_of(box_of(positions));
    cuts.tree[at.node].axis = axis;
    std::ranges::sort(positions, PositionOrder(axis, 0, dimension));
    const auto below = static_cast<std::size_t>(at.lower().num_parts);
    const auto above = static_cast<std::size_t>(at.upper().num_parts);
    const std::size_t num_below = below + engine() % (positions.size() - below - above + 1);
    const auto middle = positions.begin() + static_cast<std::ptrdiff_t>(num_below);
    divide({positions.begin(), middle}, at.lower(), dimension, axis_of, engine, cuts, held);
    divide({middle, positions.end()}, at.upper(), dimension, axis_of, engine, cuts, held);
}

Cuts divide(const Positions& positions, int num_parts, int dimension, bool across_longest,
            std::mt19937_64& engine, Distribution& held) {
    Cuts cuts = across(std::vector<int>(static_cast<std::size_t>(num_parts) - 1), dimension);
    held.assign(static_cast<std::size_t>(num_parts), {});
    const auto axis_of = [&](const Box& box) {
        int axis = static_cast<int>(engine() % static_cast<unsigned>(dimension));
        for (int a = 0; a < dimension && across_longest; ++a) {
            const auto extent = [&](int b) {
                return box.upper[static_cast<std::size_t>(b)] -
                       box.lower[static_cast<std::size_t>(b)];
            };
            if (extent(a) > extent(axis)) axis = a;
        }
        return axis;
    };
    divide(positions, root_of(cuts), dimension, axis_of, engine, cuts, held);
    return cuts;
}

TEST(KeptTree, of_a_bisection_across_the_axes_of_the_estimate_are_read) {
    std::mt19937_64 engine(1);
    for (int trial = 0; trial < 300; ++trial) {
        const int dimension = 1 + trial % 3;
        const int num_parts = 2 + trial % 11;
        Distribution held;
        const Cuts cuts = divide(lattice(dimension == 1 ? 40 : 6, dimension), num_parts, dimension,
                                 false, engine, held);
        const auto current = read(held, cuts);
        ASSERT_TRUE(current);
        expect_cuts_give_every_rank_its_part(held, *current);
        for (std::size_t node = 0; node < cuts.tree.size(); ++node)
            EXPECT_EQ(current->cuts.tree[node].axis, cuts.tree[node].axis);
        for (std::size_t rank = 0; rank < held.size(); ++rank) {
            EXPECT_EQ(current->parts[rank], static_cast<Part>(rank));
            EXPECT_EQ(current->part_weights[rank], static_cast<double>(held[rank].size()));
        }
        EXPECT_EQ(current->imbalance, imbalance(current->part_weights));
    }
}

TEST(KeptTree, across_the_longest_axes_are_read_whatever_the_estimate_and_the_ranks_numbers) {
    std::mt19937_64 engine(2);
    for (int trial = 0; trial < 300; ++trial) {
        const int dimension = 2 + trial % 2;
        const int num_parts = 2 + trial % 7;
        Distribution held;
        divide(lattice(7, dimension), num_parts, dimension, true, engine, held);
        const Cuts other = across(std::vector<int>(held.size() - 1, dimension - 1), dimension);
        const auto current = read(held, other);
        ASSERT_TRUE(current);
        expect_cuts_give_every_rank_its_part(held, *current);
    }
}

TEST(KeptTree, of_renumbered_ranks_are_read_with_the_part_of_each) {
    std::mt19937_64 engine(3);
    for (int trial = 0; trial < 300; ++trial) {
        Distribution held;
        const Cuts cuts = divide(lattice(8, 2), 2 + trial % 7, 2, false, engine, held);
        std::vector<Part> parts(held.size());
        std::iota(parts.begin(), parts.end(), 0);
        std::shuffle(parts.begin(), parts.end(), engine);
        Distribution renumbered;
        for (const Part part : parts) renumbered.push_back(held[static_cast<std::size_t>(part)]);
        const auto current = read(renumbered, cuts);
        // Of several bisections into the same blocks the first counts, and may go wrong below.
        if (!current) continue;
        expect_cuts_give_every_rank_its_part(renumbered, *current);
        std::vector<Part> sorted = current->parts;
        std::ranges::sort(sorted);
        for (std::size_t p = 0; p < sorted.size(); ++p) EXPECT_EQ(sorted[p], static_cast<Part>(p));
    }
    // A square of four: part 2 is below part 3 in the upper half.
    const Distribution square{{{1, 1}}, {{0, 1}}, {{1, 0}}, {{0, 0}}};
    const auto current = read(square, across({0, 1, 1}, 2));
    ASSERT_TRUE(current);
    EXPECT_EQ(current->parts, (std::vector<Part>{3, 1, 2, 0}));
}

/// Compares every pair of points on different sides of a cut.
bool is_bisection(const Distribution& held, std::span<const int> order, const Cuts& axes,
                  const Descent& at) {
    if (at.is_part()) return true;
    const PositionOrder is_before(axes.tree[at.node].axis, 0, axes.dimension);
    const auto below = static_cast<std::size_t>(at.lower().num_parts);
    for (const int i : order.first(below))
        for (const int j : order.subspan(below))
            for (const Vector& x : held[static_cast<std::size_t>(i)])
                for (const Vector& y : held[static_cast<std::size_t>(j)])
                    if (!is_before(x, y)) return false;
    return is_bisection(held, order.first(below), axes, at.lower()) &&
           is_bisection(held, order.subspan(below), axes, at.upper());
}

TEST(KeptTree, across_given_axes_are_read_just_where_some_order_of_the_ranks_is_a_bisection) {
    std::mt19937_64 engine(5);
    int num_read = 0;
    int num_refused = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        Positions positions = lattice(4, 2);
        std::shuffle(positions.begin(), positions.end(), engine);
        Distribution held(2 + static_cast<std::size_t>(trial % 4));
        for (std::size_t i = 0; i < 3 + held.size(); ++i)
            held[i % held.size()].push_back(positions[i]);
        Options options = options_for(held.size());
        std::vector<int> given;
        for (std::size_t node = 0; node + 1 < held.size(); ++node)
            given.push_back(static_cast<int>(engine() % 2));
        options.expert.axes.order = AxisOrder::given(given);
        const Cuts axes = across(given, 2);
        std::vector<int> order(held.size());
        std::iota(order.begin(), order.end(), 0);
        bool expected = false;
        do {
            expected = expected || is_bisection(held, order, axes, root_of(axes));
        } while (std::ranges::next_permutation(order).found);
        const auto current = read(held, axes, options);
        ASSERT_EQ(current.has_value(), expected);
        (expected ? num_read : num_refused) += 1;
        if (current) expect_cuts_give_every_rank_its_part(held, *current);
    }
    EXPECT_GT(num_read, 200);
    EXPECT_GT(num_refused, 300);
}

TEST(KeptTree, that_no_bisection_has_are_not_read) {
    const Distribution scattered{{{0, 0}, {3, 3}}, {{1, 1}, {2, 0}}, {{0, 3}, {3, 0}}, {{1, 2}}};
    EXPECT_FALSE(read(scattered, across({0, 1, 1}, 2)));
    // Five blocks turning about the one in the middle.
    const Distribution mill{
        {{0, 0}, {3, 1}}, {{4, 0}, {5, 3}}, {{2, 4}, {5, 5}}, {{0, 2}, {1, 5}}, {{2, 2}, {3, 3}}};
    for (const int axis : {0, 1}) EXPECT_FALSE(read(mill, across({axis, axis, axis, axis}, 2)));
}

TEST(KeptTree, in_slabs_of_a_square_are_not_read) {
    Distribution slabs(4);
    for (const Vector& x : lattice(8, 2)) slabs[static_cast<std::size_t>(x[0]) / 2].push_back(x);
    EXPECT_FALSE(read(slabs, across({0, 1, 1}, 2)));
    EXPECT_TRUE(read(slabs, across({0, 0, 0}, 2)));
}

TEST(KeptTree, may_lie_across_another_axis_that_is_nearly_as_long) {
    const auto halves = [](double height) {
        return Distribution{{{0, 0}, {1, 0.4 * height}}, {{0, 0.6 * height}, {1, height}}};
    };
    EXPECT_TRUE(read(halves(0.9), across({0}, 2)));
    EXPECT_FALSE(read(halves(0.7), across({0}, 2)));
    EXPECT_TRUE(read(halves(0.7), across({1}, 2)));
    Options given = options_for(2);
    given.expert.axes.order = AxisOrder::given({0});
    EXPECT_FALSE(read(halves(0.9), across({0}, 2), given));
    given.expert.axes.order = AxisOrder::grouped({0, 1});
    EXPECT_FALSE(read(halves(0.9), across({0}, 2), given));
}

TEST(KeptTree, are_cut_in_the_middle_of_a_gap_along_the_first_axis_that_has_one) {
    const auto gap = read({{{0, 5}, {1, 5}}, {{4, 0}}}, across({0}, 2));
    ASSERT_TRUE(gap);
    EXPECT_EQ(gap->cuts.tree[0].at, (Vector{2.5, -infinity, -infinity}));
    const auto tie = read({{{0, 5}, {1, 2}}, {{1, 3}, {4, 0}}}, across({0}, 2));
    ASSERT_TRUE(tie);
    EXPECT_EQ(tie->cuts.tree[0].at, (Vector{1, 2.5, -infinity}));
    Options plain = options_for(2);
    plain.expert.axes.plain = true;
    EXPECT_FALSE(read({{{0, 5}, {1, 2}}, {{1, 3}, {4, 0}}}, across({0}, 2), plain));
    const double next = std::nextafter(1.0, 2.0);
    const auto narrow = read({{{1, 0}}, {{next, 0}}}, across({0}, 2), plain);
    ASSERT_TRUE(narrow);
    EXPECT_EQ(narrow->cuts.tree[0].at[0], next);
    const double most = std::numeric_limits<double>::max();
    const auto wide = read({{{-most, 0}}, {{most, 0}}}, across({0}, 2));
    ASSERT_TRUE(wide);
    EXPECT_EQ(wide->cuts.tree[0].at[0], 0);
}

TEST(KeptTree, in_one_place_are_read_only_where_a_search_may_divide_them) {
    const Distribution held{{{0, 0}, {1, 1}}, {{1, 1}, {2, 0}}};
    EXPECT_FALSE(read(held, across({0}, 2)));
    Options options = options_for(2);
    options.expert.coincident = Coincident::divide;
    const auto divided = read(held, across({0}, 2), options);
    ASSERT_TRUE(divided);
    EXPECT_EQ(divided->cuts.tree[0].divides, 1);
    EXPECT_EQ(divided->cuts.tree[0].at, (Vector{1, 1, -infinity}));
    // The points of lower ranks would not be the ones below.
    EXPECT_FALSE(read({held[1], held[0]}, across({0}, 2), options));
    options.refine = Refine::none;
    EXPECT_FALSE(read(held, across({0}, 2), options));
}

TEST(KeptTree, may_have_ranks_without_points) {
    const Distribution held{{{0, 0}}, {}, {{2, 0}}, {{3, 0}}};
    const auto current = read(held, across({0, 0, 0}, 2));
    ASSERT_TRUE(current);
    EXPECT_EQ(current->part_weights, (std::vector<double>{1, 0, 1, 1}));
    expect_cuts_give_every_rank_its_part(held, *current);
    const auto renumbered = read({{{3, 0}}, {}, {{2, 0}}, {{0, 0}}}, across({0, 0, 0}, 2));
    ASSERT_TRUE(renumbered);
    EXPECT_EQ(renumbered->parts[0], 3);
    EXPECT_EQ(renumbered->parts[2], 2);
    EXPECT_FALSE(is_in_order(renumbered->cuts, renumbered->parts));
    EXPECT_TRUE(is_in_order(current->cuts, current->parts));
}

TEST(KeptTree, leave_parts_of_size_zero_empty) {
    Options options = options_for(4);
    options.part_sizes = {1, 0, 1, 1};
    const auto current = read({{{0, 0}}, {}, {{2, 0}}, {{3, 0}}}, across({0, 0, 0}, 2), options);
    ASSERT_TRUE(current);
    EXPECT_EQ(current->imbalance, 1);
    EXPECT_EQ(current->cuts.tree[1].at[0], infinity);
    EXPECT_FALSE(read({{{0, 0}}, {{1, 0}}, {{2, 0}}, {{3, 0}}}, across({0, 0, 0}, 2), options));
}

TEST(KeptTree, weigh_as_much_as_the_ranks) {
    std::vector<PointSummary> extents{extent_of({{0, 0}}, 2), extent_of({{1, 0}, {2, 0}}, 2)};
    extents[0].weight = 3.5;
    EXPECT_EQ(read_kept_tree(extents, across({0}, 2), options_for(2))->part_weights,
              (std::vector<double>{3.5, 2}));
}

}  // namespace
}  // namespace rrcb
