#include "estimate/cell_records.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

std::vector<Vector> cubes_of(std::span<const CellMoments> cells, int dimension, int exponent) {
    std::vector<Vector> cubes;
    cubes.reserve(cells.size());
    for (const CellMoments& cell : cells)
        cubes.push_back(cube_of(cell.moments.mean, dimension, exponent));
    return cubes;
}

std::size_t num_cubes(std::span<const CellMoments> cells, int dimension, int exponent) {
    std::vector<Vector> cubes = cubes_of(cells, dimension, exponent);
    std::sort(cubes.begin(), cubes.end());
    return static_cast<std::size_t>(std::unique(cubes.begin(), cubes.end()) - cubes.begin());
}

/// Returns half the longest edge of the box of the means; does not overflow for any coordinates.
double half_extent(std::span<const CellMoments> cells, int dimension) {
    double longest = 0;
    for (int a = 0; a < dimension; ++a) {
        const auto [low, high] = std::minmax_element(
            cells.begin(), cells.end(), [&](const auto& left, const auto& right) {
                return left.moments.mean[a] < right.moments.mean[a];
            });
        longest = std::max(longest, high->moments.mean[a] / 2 - low->moments.mean[a] / 2);
    }
    return longest;
}

/// Finds the finest lattice that is coarse enough. The search starts at the edge at which points
/// that fill their cube have about as many cells as wanted; other points leave most of the lattice
/// empty.
int finest_exponent(const CellSet& set, int dimension, std::size_t most) {
    const int lowest = std::max(set.exponent, last_digit(set.cells, dimension));
    const double half = half_extent(set.cells, dimension);
    if (half == 0) return lowest;
    const int levels = std::ilogb(static_cast<double>(most)) / dimension;
    int exponent = std::max(lowest, std::ilogb(half) + 2 - levels);
    while (num_cubes(set.cells, dimension, exponent) > most) ++exponent;
    while (exponent > lowest && num_cubes(set.cells, dimension, exponent - 1) <= most) --exponent;
    return exponent;
}

}  // namespace

int last_digit(std::span<const CellMoments> cells, int dimension) {
    constexpr int digits = 52;
    constexpr int smallest_exponent = -1000;
    double greatest = 0;
    for (const CellMoments& cell : cells)
        for (int a = 0; a < dimension; ++a)
            greatest = std::max(greatest, std::abs(cell.moments.mean[a]));
    return greatest > 0 ? std::ilogb(greatest) - digits : smallest_exponent;
}

CellSet coarsen(const CellSet& set, int dimension, std::size_t most) {
    CellSet merged;
    merged.exponent = finest_exponent(set, dimension, most);
    const std::vector<Vector> cubes = cubes_of(set.cells, dimension, merged.exponent);
    std::vector<std::size_t> order(cubes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t i, std::size_t j) { return cubes[i] < cubes[j]; });
    const Vector* last = nullptr;
    for (const std::size_t i : order) {
        if (last != nullptr && *last == cubes[i]) {
            Moments& joint = merged.cells.back().moments;
            joint = merge(joint, set.cells[i].moments);
        } else {
            merged.cells.push_back({0, {}, set.cells[i].moments});
            last = &cubes[i];
        }
    }
    return merged;
}

}  // namespace rrcb
