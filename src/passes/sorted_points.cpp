#include "passes/sorted_points.hpp"

#include "passes/cell_finder.hpp"

#include <rrcb/cuts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rrcb {

namespace {

/// Calls visit(i, cell) for the points in cells that are marked by 1, as visit_cells().
template <class Layout, class Visit>
void visit_marked_cells(const CellFinder& mesh, const Layout& x, LocalIndex count,
                        const std::uint8_t* marks, const Visit& visit) {
    constexpr LocalIndex block_length = 256;
    std::array<std::int32_t, block_length> cells;
    std::array<std::uint32_t, block_length> marked;
    in_ranges(count, block_length, [&](LocalIndex first, LocalIndex last) {
        find_cells(mesh, x, first, last - first, cells.data());
        std::size_t num_marked = 0;
        // Without branches, which points in any order would mispredict.
        for (std::uint32_t k = 0; k < last - first; ++k) {
            marked[num_marked] = k;
            num_marked += marks[cells[k]];
        }
        for (const std::uint32_t k : std::span(marked).first(num_marked))
            visit(first + k, static_cast<std::size_t>(cells[k]));
    });
}

template <bool Weighted, class Layout>
void scatter(const Layout& points, const BinnedPoints& binned, SortedPoints& sorted) {
    constexpr auto dimension = static_cast<std::size_t>(Layout::dimension);
    std::vector<LocalIndex> places(sorted.begins.begin(), sorted.begins.end() - 1);
    // Copies, so that the compiler knows that writes do not change them.
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
    const CellFinder finder(binned.mesh);
    if (sorted.is_sorted.empty()) return visit_cells(finder, points, 0, binned.points.count, add);
    visit_marked_cells(finder, points, binned.points.count, sorted.is_sorted.data(), add);
}

void scatter(const BinnedPoints& binned, SortedPoints& sorted) {
    visit_layout(binned.points, [&](const auto& x) {
        if (binned.points.weights.empty()) return scatter<false>(x, binned, sorted);
        scatter<true>(x, binned, sorted);
    });
}

/// Returns the weights of the cells, added up in the order of the sorted points.
std::vector<double> weigh_cells(const BinnedPoints& binned) {
    const Points& points = binned.points;
    std::vector<double> sums(points.weights.empty() ? 0 : binned.counts.size());
    if (sums.empty()) return sums;
    visit_layout(points, [&](const auto& x) {
        visit_cells(CellFinder(binned.mesh), x, 0, points.count,
                    [to = sums.data(), weights = points.weights.data()](
                        LocalIndex i, std::size_t cell) { to[cell] += weights[i]; });
    });
    return sums;
}

/// Resizes without a copy of old entries.
template <class Value>
void resize(Uninitialized<Value>& values, std::size_t size) {
    values.clear();
    values.resize(size);
}

}  // namespace

SortedPoints sort_by_cell(const BinnedPoints& binned, SortedPoints memory,
                          std::vector<std::uint8_t> is_sorted) {
    const Points& points = binned.points;
    SortedPoints sorted = std::move(memory);
    sorted.mesh = binned.mesh;
    sorted.begins.resize(binned.counts.size() + 1);
    std::partial_sum(binned.counts.begin(), binned.counts.end(), sorted.begins.begin() + 1);
    resize(sorted.coordinates, points.count * static_cast<std::size_t>(points.dimension));
    resize(sorted.weights, points.weights.size());
    resize(sorted.original, points.count);
    sorted.is_sorted = std::move(is_sorted);
    sorted.binned = sorted.is_sorted.empty() ? nullptr : &binned;
    sorted.cell_weights.clear();
    if (sorted.binned != nullptr) sorted.cell_weights = weigh_cells(binned);
    scatter(binned, sorted);
    return sorted;
}

void sort_rest(SortedPoints& points) {
    for (std::uint8_t& mark : points.is_sorted) mark = mark == 0 ? 1 : 0;
    scatter(*points.binned, points);
    points.is_sorted.clear();
}

void write_parts_of_cells(const BinnedPoints& binned, std::span<const Part> parts_of_cells,
                          std::span<Part> parts) {
    static_assert(no_part == -1);
    visit_layout(binned.points, [&](const auto& x) {
        visit_cells(
            CellFinder(binned.mesh), x, 0, binned.points.count,
            [from = parts_of_cells.data(), to = parts.data()](LocalIndex i, std::size_t cell) {
                // Without a branch: all bits of no_part are 1.
                const Part part = from[cell];
                const Part keeps = part >> std::numeric_limits<Part>::digits;
                to[i] = part ^ ((part ^ to[i]) & keeps);
            });
    });
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
