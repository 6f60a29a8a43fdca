#include "cells/sorted_points.hpp"

#include "cells/cell_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

template <class Layout>
void scatter(const Layout& x, const BinnedPoints& binned, SortedPoints& sorted) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    std::vector<LocalIndex> next(sorted.begins.begin(), sorted.begins.end() - 1);
    const Points& points = binned.points;
    visit_cells(CellFinder(binned.mesh), x, 0, points.count, [&](LocalIndex i, std::size_t cell) {
        const LocalIndex place = next[cell]++;
        for (std::size_t a = 0; a < dimension; ++a)
            sorted.coordinates[place * dimension + a] = x(i, static_cast<int>(a));
        sorted.original[place] = i;
        if (!points.weights.empty()) sorted.weights[place] = points.weights[i];
    });
}

}  // namespace

Vector SortedPoints::position(LocalIndex i) const {
    const auto d = static_cast<std::size_t>(mesh.dimension);
    Vector x{};
    for (std::size_t a = 0; a < d; ++a) x[a] = coordinates[i * d + a];
    return x;
}

SortedPoints sort_by_cell(const BinnedPoints& binned) {
    const Points& points = binned.points;
    SortedPoints sorted;
    sorted.mesh = binned.mesh;
    sorted.begins.resize(binned.counts.size() + 1);
    std::partial_sum(binned.counts.begin(), binned.counts.end(), sorted.begins.begin() + 1);
    sorted.coordinates.resize(points.count * static_cast<std::size_t>(points.dimension));
    sorted.weights.resize(points.weights.size());
    sorted.original.resize(points.count);
    visit_layout(points, [&](const auto& x) { scatter(x, binned, sorted); });
    return sorted;
}

Box enclosing_box(const SupportMesh& mesh, LocalIndex cell) {
    constexpr double margin = 8 * std::numeric_limits<double>::epsilon();
    Box box = cell_box(mesh, cell);
    for (int a = 0; a < mesh.dimension; ++a) {
        const double largest = std::max(std::abs(mesh.box.lower[a]), std::abs(mesh.box.upper[a]));
        box.lower[a] = std::max(mesh.box.lower[a], box.lower[a] - margin * largest);
        box.upper[a] = std::min(mesh.box.upper[a], box.upper[a] + margin * largest);
    }
    return box;
}

}  // namespace rrcb
