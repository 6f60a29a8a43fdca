#include "passes/binned_points.hpp"

#include "../support/clouds.hpp"
#include "passes/cell_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace rrcb {
namespace {

BinnedPoints bin(const Points& points, int cells_per_axis) {
    return bin_by_cell(points,
                       make_support_mesh(bounding_box(points), points.dimension, cells_per_axis));
}

/// The cell of each point.
std::vector<LocalIndex> cells_of(const Points& points, const SupportMesh& mesh) {
    std::vector<LocalIndex> cells;
    visit_layout(points, [&](const auto& x) {
        visit_cells(CellFinder(mesh), x, 0, points.count,
                    [&](LocalIndex, std::size_t cell) { cells.push_back(cell); });
    });
    return cells;
}

/// The coordinates of interleaved points, one axis after the other.
std::vector<double> by_column(const std::vector<double>& interleaved, std::size_t dimension) {
    std::vector<double> columns;
    for (std::size_t a = 0; a < dimension; ++a)
        for (std::size_t k = a; k < interleaved.size(); k += dimension)
            columns.push_back(interleaved[k]);
    return columns;
}

Points view_of_columns(const std::vector<double>& columns, std::size_t dimension) {
    std::vector<std::span<const double>> axes;
    const std::size_t count = columns.size() / dimension;
    for (std::size_t a = 0; a < dimension; ++a)
        axes.push_back(std::span(columns).subspan(a * count, count));
    return column_points(axes);
}

TEST(BinnedPoints, cells_are_those_of_the_mesh) {
    for (const int dimension : {1, 2, 3}) {
        for (const int cells : {1, 3, 8, 40}) {
            const auto d = static_cast<std::size_t>(dimension);
            const std::vector<double> all = test::uniform_cloud(5003, dimension, 3);
            const std::vector<double> columns = by_column(all, d);
            const BinnedPoints binned = bin(interleaved_points(all, dimension), cells);
            const std::vector<LocalIndex> found = cells_of(binned.points, binned.mesh);
            EXPECT_EQ(cells_of(view_of_columns(columns, d), binned.mesh), found);
            std::vector<LocalIndex> counts(num_cells(binned.mesh));
            for (LocalIndex i = 0; i < binned.points.count; ++i) {
                const LocalIndex cell = cell_of(binned.mesh, binned.points.position(i));
                EXPECT_EQ(found[i], cell);
                ++counts[cell];
            }
            EXPECT_EQ(binned.counts, counts);
        }
    }
}

TEST(BinnedPoints, faces_belong_to_the_cell_above_and_those_of_the_box_to_the_last) {
    const std::vector<double> x{0, 1, 1, 2, 3, 4};
    const std::array<std::span<const double>, 1> columns{x};
    const std::vector<double> weights{1, 2, 4, 8, 16, 32};
    const BinnedPoints binned = bin(column_points(columns, weights), 4);
    EXPECT_EQ(cells_of(binned.points, binned.mesh), (std::vector<LocalIndex>{0, 1, 1, 2, 3, 3}));
    EXPECT_EQ(binned.counts, (std::vector<LocalIndex>{1, 2, 1, 2}));
    EXPECT_EQ(binned.weights, (std::vector<double>{1, 6, 8, 48}));
    EXPECT_EQ(binned.origins, (std::vector<double>{0, 1, 2, 3}));
    EXPECT_EQ(binned.first_moments, (std::vector<double>{0, 0, 0, 32}));
    EXPECT_EQ(binned.second_moments, (std::vector<double>{0, 0, 0, 32}));
}

}  // namespace
}  // namespace rrcb
