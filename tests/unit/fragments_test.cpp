#include "search/fragments.hpp"

#include "../support/clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {
namespace {

/// Points on a line in a mesh of two cells.
SortedPoints sorted(const std::vector<double>& x, const std::vector<double>& weights = {}) {
    const Points points = interleaved_points(x, 1, weights);
    return sort_by_cell(bin_by_cell(points, make_support_mesh(bounding_box(points), 1, 2)));
}

Cut cut_at(double value) {
    Cut cut;
    cut.at.fill(-std::numeric_limits<double>::infinity());
    cut.at[0] = value;
    return cut;
}

std::vector<double> positions_in(const std::vector<Fragment>& fragments,
                                 const SortedPoints& points) {
    std::vector<double> positions;
    for (const Fragment& fragment : fragments)
        for (LocalIndex i = fragment.begin; i < fragment.end; ++i)
            positions.push_back(points.position(i)[0]);
    std::ranges::sort(positions);
    return positions;
}

TEST(Fragments, are_the_cells_that_hold_points) {
    const SortedPoints points = sorted({0, 4, 3.5, 1}, {1, 2, 4, 8});
    const auto fragments = cell_fragments(points);
    ASSERT_EQ(fragments.size(), 2u);
    EXPECT_EQ(fragments[0].weight, 9);
    EXPECT_EQ(fragments[1].weight, 6);
    EXPECT_EQ(cell_fragments(sorted({3})).size(), 1u);
}

TEST(Fragments, are_split_by_a_cut_inside_a_cell_or_between_two) {
    for (const auto& [value, num_fragments] : {std::pair{0.5, 3u}, std::pair{2.0, 2u}}) {
        SortedPoints points = sorted({0, 4, 3.5, 1, 0.25});
        const auto [lower, upper] = split(cell_fragments(points), cut_at(value), {}, points);
        EXPECT_EQ(lower.size() + upper.size(), num_fragments);
        for (const double x : positions_in(lower, points)) EXPECT_LT(x, value);
        for (const double x : positions_in(upper, points)) EXPECT_GE(x, value);
        EXPECT_EQ(positions_in(lower, points).size() + positions_in(upper, points).size(), 5u);
    }
}

TEST(Fragments, of_points_at_a_cut_go_below_until_the_weight_due_there_is_reached) {
    // Ranks before this one hold `before` of the weight at the cut, of which 2 belong below.
    for (const auto& [before, num_below] :
         {std::pair{0.0, 2u}, std::pair{1.0, 1u}, std::pair{2.0, 0u}, std::pair{5.0, 0u}}) {
        SortedPoints points = sorted({0, 2, 2, 2, 4});
        Cut cut = cut_at(2);
        EXPECT_EQ(points_at(cut, cell_fragments(points), points).weight, 3);
        const auto [lower, upper] = split(cell_fragments(points), cut, {before, 2}, points);
        EXPECT_EQ(positions_in(lower, points).size(), 1 + num_below) << before;
        EXPECT_EQ(positions_in(upper, points).size(), 4 - num_below) << before;
    }
}

TEST(Fragments, write_their_part_in_the_order_points_had) {
    SortedPoints points = sorted({4, 0, 3, 1}, {1, 2, 4, 8});
    const auto [lower, upper] = split(cell_fragments(points), cut_at(2.5), {}, points);
    std::vector<Part> parts(4, -1);
    EXPECT_EQ(write_part(lower, 6, points, parts), 10);
    EXPECT_EQ(write_part(upper, 7, points, parts), 5);
    EXPECT_EQ(parts, (std::vector<Part>{7, 6, 7, 6}));
}

/// Points of a lattice with weights, in a mesh of 3 x 3 cells.
struct Lattice {
    std::vector<double> coordinates;
    std::vector<double> weights;

    explicit Lattice(std::mt19937_64& engine) {
        const auto upto = [&](double end) { return std::floor(test::uniform(engine, 0, end)); };
        for (int i = 0; i < 60; ++i) {
            coordinates.insert(coordinates.end(), {upto(5), upto(5)});
            weights.push_back(upto(4));
        }
    }

    SortedPoints sorted() const {
        const Points points = interleaved_points(coordinates, 2, weights);
        return sort_by_cell(bin_by_cell(points, make_support_mesh(bounding_box(points), 2, 3)));
    }
};

void expect_sound(const std::vector<Fragment>& fragments, const SortedPoints& points) {
    for (const Fragment& fragment : fragments) {
        ASSERT_LT(fragment.begin, fragment.end);
        double weight = 0;
        for (LocalIndex i = fragment.begin; i < fragment.end; ++i) {
            weight += points.weight(i);
            for (std::size_t a = 0; a < 2; ++a) {
                EXPECT_GE(points.position(i)[a], fragment.box.lower[a]);
                EXPECT_LE(points.position(i)[a], fragment.box.upper[a]);
            }
        }
        EXPECT_EQ(weight, fragment.weight);
    }
}

TEST(Fragments, split_again_and_again_hold_every_point_once_on_its_side) {
    std::mt19937_64 engine(4);
    for (int round = 0; round < 200; ++round) {
        const Lattice lattice(engine);
        SortedPoints points = lattice.sorted();
        std::vector<std::vector<Fragment>> nodes{cell_fragments(points)};
        std::vector<std::vector<std::pair<Cut, bool>>> paths(1);
        for (int level = 0; level < 3; ++level) {
            std::vector<std::vector<Fragment>> children;
            std::vector<std::vector<std::pair<Cut, bool>>> longer;
            for (std::size_t k = 0; k < nodes.size(); ++k) {
                // A place on the lattice, so that ties are broken along the other axis.
                Cut cut;
                cut.axis = static_cast<int>(engine() % 2);
                cut.at = {static_cast<double>(engine() % 6), static_cast<double>(engine() % 6)};
                auto [lower, upper] = split(nodes[k], cut, {}, points);
                children.insert(children.end(), {std::move(lower), std::move(upper)});
                for (const bool above : {false, true}) {
                    longer.push_back(paths[k]);
                    longer.back().emplace_back(cut, above);
                }
            }
            nodes = std::move(children);
            paths = std::move(longer);
        }
        std::vector<int> seen(60);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            expect_sound(nodes[k], points);
            for (const Fragment& fragment : nodes[k])
                for (LocalIndex i = fragment.begin; i < fragment.end; ++i) {
                    const LocalIndex before = points.original[i];
                    ++seen[before];
                    EXPECT_EQ(points.position(i)[0], lattice.coordinates[2 * before]);
                    EXPECT_EQ(points.position(i)[1], lattice.coordinates[2 * before + 1]);
                    EXPECT_EQ(points.weight(i), lattice.weights[before]);
                    for (const auto& [cut, above] : paths[k])
                        EXPECT_EQ(is_above(cut, points.position(i), 2), above);
                }
        }
        EXPECT_EQ(seen, std::vector<int>(60, 1));
    }
}

TEST(Fragments, weigh_what_lies_exactly_at_a_cut) {
    std::mt19937_64 engine(5);
    for (int round = 0; round < 100; ++round) {
        const Lattice lattice(engine);
        const SortedPoints points = lattice.sorted();
        const double x = static_cast<double>(engine() % 5);
        const double y = static_cast<double>(engine() % 5);
        Cut cut;
        cut.at = {x, y};
        double weight = 0;
        for (std::size_t i = 0; i < 60; ++i)
            if (lattice.coordinates[2 * i] == x && lattice.coordinates[2 * i + 1] == y)
                weight += lattice.weights[i];
        EXPECT_EQ(points_at(cut, cell_fragments(points), points).weight, weight);
    }
}

TEST(Fragments, of_a_lot_on_several_ranks_miss_the_weight_due_by_half_a_point_at_most) {
    std::mt19937_64 engine(6);
    for (int round = 0; round < 200; ++round) {
        const double due = test::uniform(engine, 0, 30);
        double before = 0;
        double below = 0;
        for (int rank = 0; rank < 3; ++rank) {
            std::vector<double> weights{0, 0};
            for (int i = 0; i < 5; ++i) weights.push_back(1 + 3 * test::uniform(engine));
            SortedPoints points = sorted({0, 4, 2, 2, 2, 2, 2}, weights);
            const Cut cut = cut_at(2);
            const auto fragments = cell_fragments(points);
            const double here = points_at(cut, fragments, points).weight;
            const auto [lower, upper] = split(fragments, cut, {before, due}, points);
            for (const Fragment& fragment : lower) below += fragment.weight;
            before += here;
        }
        if (due >= before) continue;
        EXPECT_NEAR(below, due, 2) << "the heaviest weighs 4";
    }
}

}  // namespace
}  // namespace rrcb
