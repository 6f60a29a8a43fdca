// Cells that a search leaves out until it needs them, against a search of all points.
#include "../support/clouds.hpp"
#include "collective/butterfly.hpp"
#include "passes/sorted_points.hpp"
#include "search/tree_search.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace rrcb {
namespace {

constexpr int cells_per_axis = 12;

BinnedPoints bin(const Points& points) {
    return bin_by_cell(points, make_support_mesh(bounding_box(points), 2, cells_per_axis));
}

std::vector<double> weights_of(std::size_t count, bool weighted) {
    std::vector<double> weights;
    for (std::size_t i = 0; weighted && i < count; ++i)
        weights.push_back(0.1 + static_cast<double>(i % 7));
    return weights;
}

TEST(LeftOutCells, are_sorted_later_as_if_they_had_been_at_first) {
    const std::vector<double> x = test::uniform_cloud(1000, 2, 3);
    for (const bool weighted : {false, true}) {
        const std::vector<double> weights = weights_of(1000, weighted);
        const Points points = interleaved_points(x, 2, weights);
        const BinnedPoints binned = bin(points);
        const SortedPoints all = sort_by_cell(binned);
        std::vector<std::uint8_t> marks(binned.counts.size());
        for (std::size_t cell = 0; cell < marks.size(); ++cell) marks[cell] = cell % 3 == 0;
        SortedPoints some = sort_by_cell(binned, {}, marks);
        for (LocalIndex cell = 0; cell < marks.size(); ++cell) {
            EXPECT_EQ(some.is_left_out(cell), marks[cell] == 0);
            for (LocalIndex i = some.begins[cell]; marks[cell] != 0 && i < some.begins[cell + 1];
                 ++i)
                EXPECT_EQ(some.original[i], all.original[i]);
        }
        const auto fragments_of_all = cell_fragments(all);
        const auto fragments = cell_fragments(some);
        ASSERT_EQ(fragments.size(), fragments_of_all.size());
        for (std::size_t k = 0; k < fragments.size(); ++k)
            EXPECT_EQ(fragments[k].weight, fragments_of_all[k].weight);
        sort_rest(some);
        EXPECT_EQ(some.original, all.original);
        EXPECT_EQ(some.coordinates, all.coordinates);
        EXPECT_EQ(some.weights, all.weights);
        EXPECT_FALSE(some.is_left_out(1));
    }
}

TEST(LeftOutCells, give_their_part_to_their_points_and_to_no_other) {
    const std::vector<double> x = test::uniform_cloud(1000, 2, 3);
    const BinnedPoints binned = bin(interleaved_points(x, 2));
    std::vector<Part> of_cells(binned.counts.size(), no_part);
    of_cells[7] = 5;
    of_cells[80] = 0;
    std::vector<Part> parts(1000, 3);
    write_parts_of_cells(binned, of_cells, parts);
    for (LocalIndex i = 0; i < parts.size(); ++i) {
        const LocalIndex cell = cell_of(binned.mesh, binned.points.position(i));
        EXPECT_EQ(parts[i], of_cells[cell] == no_part ? 3 : of_cells[cell]);
    }
}

struct Found {
    std::vector<Part> parts;
    std::vector<Cut> cuts;
    std::vector<double> weights;
    bool needed_all = false;
};

/// Exact cuts of four parts from cuts at 1/2, which are looked for within `width` first.
Found search(const Points& points, double weight, double width, bool leaves_out) {
    const BinnedPoints binned = bin(points);
    Cuts cuts{2, 4, {}, {}, {}};
    for (const int axis : {0, 1, 1}) {
        Cut& cut = cuts.tree.emplace_back();
        cut.axis = axis;
        cut.at.fill(0.5);
    }
    const std::vector<Bracket> brackets(3, {0.5 - width, 0.5 + width});
    const std::vector<double> sizes(4, 1.0);
    PartSums sums(4);
    PartTree tree;
    tree.num_parts = 4;
    tree.weight = weight;
    tree.rule = {sizes, 1, points.weights.empty() ? 1.0 : 0.0, 7, weight / 4, 0, true, false};
    Found found;
    found.parts.resize(points.count, no_part);
    const Guide guide{cuts, brackets, nullptr, sums, false};
    std::vector<std::uint8_t> cells;
    if (leaves_out) cells = cells_in_brackets(binned, cuts, brackets);
    EXPECT_EQ(cells.empty(), !leaves_out);
    TreeSearch search(tree, 0, guide, sort_by_cell(binned, {}, cells), found.parts);
    Butterfly butterfly(0, 1, TreeSearch::join, Butterfly::Way::central);
    while (search.is_searching()) {
        butterfly.clear();
        search.ask(butterfly);
        butterfly.start({});
        search.decide(butterfly);
        search.follow(butterfly);
    }
    search.write_rest();
    found.needed_all = search.take_points().is_sorted.empty();
    found.cuts = cuts.tree;
    found.weights.assign(sums.here().begin(), sums.here().end());
    return found;
}

TEST(LeftOutCells, change_no_cut_and_no_part) {
    for (const bool weighted : {false, true}) {
        for (const bool is_near : {true, false}) {
            std::vector<double> x = test::uniform_cloud(3000, 2, 3);
            // Far from where the brackets expect them, the cuts need all points.
            if (!is_near)
                for (double& value : x) value *= value * value;
            const std::vector<double> weights = weights_of(3000, weighted);
            const Points points = interleaved_points(x, 2, weights);
            double weight = 3000;
            if (weighted) weight = std::accumulate(weights.begin(), weights.end(), 0.0);
            const Found all = search(points, weight, 0.03, false);
            const Found some = search(points, weight, 0.03, true);
            EXPECT_EQ(some.needed_all, !is_near);
            EXPECT_EQ(some.parts, all.parts);
            EXPECT_EQ(some.weights, all.weights);
            for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(some.cuts[k].at, all.cuts[k].at);
        }
    }
}

}  // namespace
}  // namespace rrcb
