#include "point_layout.hpp"

#include <rrcb/sorted_points.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

/// Cell of every point, and how many points each cell holds in counts[cell + 1].
template <class Layout>
std::vector<std::uint32_t> cells_of(const Layout& x, LocalIndex count, const SupportMesh& mesh,
                                    std::vector<LocalIndex>& counts) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    std::array<double, dimension> lower;
    std::array<double, dimension> scale;
    std::array<double, dimension> cells_per_length;
    std::array<std::int32_t, dimension> cells;
    for (std::size_t a = 0; a < dimension; ++a) {
        scale[a] = mesh.scale[a];
        lower[a] = mesh.box.lower[a] * scale[a];
        cells_per_length[a] = mesh.cells_per_length[a];
        cells[a] = mesh.cells[a];
    }
    std::vector<std::uint32_t> cell_of_point(count);
    for (LocalIndex i = 0; i < count; ++i) {
        std::int32_t cell = 0;
        for (std::size_t a = dimension; a-- > 0;) {
            const double offset = x(i, static_cast<int>(a)) * scale[a] - lower[a];
            const auto layer = static_cast<std::int32_t>(offset * cells_per_length[a]);
            cell = cell * cells[a] + std::min(layer, cells[a] - 1);
        }
        cell_of_point[i] = static_cast<std::uint32_t>(cell);
        ++counts[static_cast<std::size_t>(cell) + 1];
    }
    return cell_of_point;
}

template <class Layout>
void scatter(const Layout& x, const Points& points, std::span<const std::uint32_t> cell_of_point,
             SortedPoints& sorted) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    std::vector<LocalIndex> next(sorted.first.begin(), sorted.first.end() - 1);
    for (LocalIndex i = 0; i < points.count; ++i) {
        const LocalIndex place = next[cell_of_point[i]]++;
        for (std::size_t a = 0; a < dimension; ++a)
            sorted.coordinates[place * dimension + a] = x(i, static_cast<int>(a));
        sorted.original[place] = i;
        if (!points.weights.empty()) sorted.weights[place] = points.weights[i];
    }
}

}  // namespace

Vector SortedPoints::position(LocalIndex i) const {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Vector x{};
    for (std::size_t a = 0; a < d; ++a) x[a] = coordinates[i * d + a];
    return x;
}

SortedPoints sort_by_cell(const Points& points, const SupportMesh& mesh) {
    SortedPoints sorted;
    sorted.mesh = mesh;
    sorted.first.resize(num_cells(mesh) + 1);
    if (points.count == 0) return sorted;
    sorted.coordinates.resize(points.count * static_cast<std::size_t>(points.dimension));
    sorted.weights.resize(points.weights.size());
    sorted.original.resize(points.count);
    visit_layout(points, [&](const auto& x) {
        const auto cell_of_point = cells_of(x, points.count, mesh, sorted.first);
        std::partial_sum(sorted.first.begin(), sorted.first.end(), sorted.first.begin());
        scatter(x, points, cell_of_point, sorted);
    });
    return sorted;
}

Box enclosing_box(const SupportMesh& mesh, LocalIndex cell) {
    constexpr double margin = 8 * std::numeric_limits<double>::epsilon();
    Box box = cell_box(mesh, cell);
    for (std::size_t a = 0; a < static_cast<std::size_t>(mesh.dimension); ++a) {
        const double largest = std::max(std::abs(mesh.box.lower[a]), std::abs(mesh.box.upper[a]));
        box.lower[a] = std::max(mesh.box.lower[a], box.lower[a] - margin * largest);
        box.upper[a] = std::min(mesh.box.upper[a], box.upper[a] + margin * largest);
    }
    return box;
}

}  // namespace rrcb
