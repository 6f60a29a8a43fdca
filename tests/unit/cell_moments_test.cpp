#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "passes/cell_finder.hpp"

#include <rrcb/detail/moments.hpp>

namespace rrcb {
namespace {

SupportMesh mesh_of(const Points& points, int cells_per_axis) {
    return make_support_mesh(bounding_box(points), points.dimension, cells_per_axis);
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
    return Points(axes);
}

TEST(CellMoments, cells_are_those_of_the_mesh) {
    for (const int dimension : {1, 2, 3}) {
        for (const int cells : {1, 3, 8, 40}) {
            const auto d = static_cast<std::size_t>(dimension);
            const std::vector<double> all = test::uniform_cloud(5003, dimension, 3);
            const std::vector<double> columns = by_column(all, d);
            const Points points(all, dimension);
            const SupportMesh mesh = mesh_of(points, cells);
            const std::vector<LocalIndex> found = cells_of(points, mesh);
            EXPECT_EQ(cells_of(view_of_columns(columns, d), mesh), found);
            std::vector<LocalIndex> counts(num_cells(mesh));
            for (LocalIndex i = 0; i < points.count; ++i) {
                const LocalIndex cell = cell_of(mesh, points.position(i));
                EXPECT_EQ(found[i], cell);
                ++counts[cell];
            }
            std::vector<LocalIndex> counted(counts.size());
            for (const CellMoments& one : cell_moments(points, mesh))
                counted[one.cell] = static_cast<LocalIndex>(one.moments.count);
            EXPECT_EQ(counted, counts);
        }
    }
}

TEST(CellMoments, faces_belong_to_the_cell_above_and_those_of_the_box_to_the_last) {
    const std::vector<double> x{0, 1, 1, 2, 3, 4};
    const std::array<std::span<const double>, 1> columns{x};
    const std::vector<double> weights{1, 2, 4, 8, 16, 32};
    const Points points(columns, weights);
    const SupportMesh mesh = mesh_of(points, 4);
    EXPECT_EQ(cells_of(points, mesh), (std::vector<LocalIndex>{0, 1, 1, 2, 3, 3}));
    const std::vector<CellMoments> cells = cell_moments(points, mesh);
    ASSERT_EQ(cells.size(), 4);
    const std::vector<GlobalCount> counts{1, 2, 1, 2};
    const std::vector<double> expected{1, 6, 8, 48};
    const std::vector<double> means{0, 1, 2, 3 + 2.0 / 3};
    for (std::size_t k = 0; k < cells.size(); ++k) {
        EXPECT_EQ(cells[k].moments.count, counts[k]);
        EXPECT_EQ(cells[k].moments.weight, expected[k]);
        EXPECT_DOUBLE_EQ(cells[k].moments.mean[0], means[k]);
    }
}

}  // namespace
}  // namespace rrcb
