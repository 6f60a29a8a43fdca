#include "cells/sorted_points.hpp"

#include "cells/cell_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rrcb {

namespace {

template <bool Weighted, class Layout>
void scatter(const Layout& points, const BinnedPoints& binned, SortedPoints& sorted) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    std::vector<LocalIndex> places(sorted.begins.begin(), sorted.begins.end() - 1);
    // Copies, which the writes can't change.
    const auto add = [x = points, next = places.data(), to = sorted.coordinates.data(),
                      original = sorted.original.data(), weights = sorted.weights.data(),
                      weights_before = binned.points.weights.data()](LocalIndex i,
                                                                     std::size_t cell) {
        const LocalIndex place = next[cell]++;
        std::array<double, dimension> position;
        for (std::size_t a = 0; a < dimension; ++a) position[a] = x(i, static_cast<int>(a));
        std::ranges::copy(position, &to[place * dimension]);
        original[place] = i;
        if constexpr (Weighted) weights[place] = weights_before[i];
    };
    visit_cells(CellFinder(binned.mesh), points, 0, binned.points.count, add);
}

/// Without a copy of the entries if it grows.
template <class Value>
void resize(Uninitialized<Value>& values, std::size_t size) {
    values.clear();
    values.resize(size);
}

}  // namespace

SortedPoints sort_by_cell(const BinnedPoints& binned, SortedPoints memory) {
    const Points& points = binned.points;
    SortedPoints sorted = std::move(memory);
    sorted.mesh = binned.mesh;
    sorted.begins.resize(binned.counts.size() + 1);
    std::partial_sum(binned.counts.begin(), binned.counts.end(), sorted.begins.begin() + 1);
    resize(sorted.coordinates, points.count * static_cast<std::size_t>(points.dimension));
    resize(sorted.weights, points.weights.size());
    resize(sorted.original, points.count);
    visit_layout(points, [&](const auto& x) {
        if (points.weights.empty()) return scatter<false>(x, binned, sorted);
        scatter<true>(x, binned, sorted);
    });
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
