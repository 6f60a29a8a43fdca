#include "estimate/cell_records.hpp"

#include <rrcb/detail/support_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rrcb {

namespace {

/// Number of doubles in the head of a block: the number of cells; the exponent of the lattice or of
/// lean weights; the unit of the weights; and the number of doubles of lean cells, or 0 for cells
/// of a lattice.
constexpr std::size_t head_length = 4;

/// Appends one cell as doubles: its number, count and weight, then the mean and the deviation along
/// each axis.
void append_cell(const CellMoments& cell, int dimension, std::vector<double>& records) {
    records.insert(records.end(), {static_cast<double>(cell.cell),
                                   static_cast<double>(cell.moments.count), cell.moments.weight});
    append_vector(cell.moments.mean, dimension, records);
    append_vector(cell.moments.deviation, dimension, records);
}

CellMoments take_cell(std::span<const double>& records, int dimension) {
    CellMoments cell;
    const auto taken = take(records, 3);
    cell.cell = static_cast<LocalIndex>(taken[0]);
    cell.moments.count = static_cast<GlobalCount>(taken[1]);
    cell.moments.weight = taken[2];
    cell.moments.mean = take_vector(records, dimension);
    cell.moments.deviation = take_vector(records, dimension);
    return cell;
}

/// Returns the box of a merged cell: the cube that contains its mean, widened to the extent of a
/// uniform density with its moments. The latter is needed because merged cells may reach far beyond
/// the cube.
Box box_of_merged(const Moments& moments, int dimension, int exponent) {
    constexpr double largest = std::numeric_limits<double>::max();
    const Vector cube = cube_of(moments.mean, dimension, exponent);
    Box box;
    for (std::size_t a = 0; a < cube.size(); ++a) {
        const double half_width = std::sqrt(3.0) * moments.deviation[a];
        box.lower[a] = std::max(
            -largest, std::min(std::ldexp(cube[a], exponent), moments.mean[a] - half_width));
        box.upper[a] = std::min(
            largest, std::max(std::ldexp(cube[a] + 1, exponent), moments.mean[a] + half_width));
    }
    return box;
}

void append_mesh(const SupportMesh& mesh, std::vector<double>& records) {
    append_vector(mesh.box.lower, mesh.dimension, records);
    append_vector(mesh.box.upper, mesh.dimension, records);
    records.insert(records.end(), mesh.cells.begin(), mesh.cells.begin() + mesh.dimension);
    append_vector(mesh.frame.lower, mesh.dimension, records);
    append_vector(mesh.frame.upper, mesh.dimension, records);
}

/// Reads as much of a mesh as is needed for the boxes of its cells.
SupportMesh take_mesh(std::span<const double>& records, int dimension) {
    Box box;
    box.lower = take_vector(records, dimension);
    box.upper = take_vector(records, dimension);
    SupportMesh mesh = make_support_mesh(box, dimension, 1);
    const auto cells = take(records, dimension);
    std::ranges::transform(cells, mesh.cells.begin(),
                           [](double number) { return static_cast<int>(number); });
    mesh.frame.lower = take_vector(records, dimension);
    mesh.frame.upper = take_vector(records, dimension);
    return mesh;
}

void take_lattice(std::span<const double>& records, std::size_t count, int dimension, int exponent,
                  CellSet& all) {
    all.exponent = std::max(all.exponent, exponent);
    for (std::size_t k = 0; k < count; ++k) {
        CellMoments cell = take_cell(records, dimension);
        cell.box = box_of_merged(cell.moments, dimension, exponent);
        all.cells.push_back(cell);
    }
}

}  // namespace

void append_vector(const Vector& x, int dimension, std::vector<double>& records) {
    records.insert(records.end(), x.begin(), x.begin() + dimension);
}

std::span<const double> take(std::span<const double>& records, std::size_t count) {
    const auto taken = records.first(count);
    records = records.subspan(count);
    return taken;
}

Vector take_vector(std::span<const double>& records, int dimension) {
    Vector x{};
    const auto taken = take(records, dimension);
    std::copy(taken.begin(), taken.end(), x.begin());
    return x;
}

Vector cube_of(const Vector& position, int dimension, int exponent) {
    Vector cube{};
    for (int a = 0; a < dimension; ++a) cube[a] = std::floor(std::ldexp(position[a], -exponent));
    return cube;
}

void append_lean_cells(std::span<const CellMoments> cells, const SupportMesh& mesh, double unit,
                       std::vector<double>& records) {
    const LeanCells lean = pack_cells(cells, mesh);
    const std::size_t num_packed = (lean.bytes.size() + sizeof(double) - 1) / sizeof(double);
    records.insert(records.end(),
                   {static_cast<double>(cells.size()), static_cast<double>(lean.exponent), unit,
                    static_cast<double>(num_packed)});
    append_mesh(mesh, records);
    records.resize(records.size() + num_packed);
    std::ranges::copy(lean.bytes,
                      std::as_writable_bytes(std::span(records).last(num_packed)).begin());
}

void append_cells(const CellSet& merged, int dimension, double unit, std::vector<double>& records) {
    records.insert(records.end(), {static_cast<double>(merged.cells.size()),
                                   static_cast<double>(merged.exponent), unit, 0});
    for (const CellMoments& cell : merged.cells) append_cell(cell, dimension, records);
}

CellSet read_cells(std::span<const double> records, int dimension, bool in_units) {
    CellSet all;
    while (!records.empty()) {
        const auto head = take(records, head_length);
        const auto count = static_cast<std::size_t>(head[0]);
        const auto exponent = static_cast<int>(head[1]);
        const auto num_packed = static_cast<std::size_t>(head[3]);
        if (num_packed == 0) {
            take_lattice(records, count, dimension, exponent, all);
        } else {
            const SupportMesh mesh = take_mesh(records, dimension);
            const auto packed = take(records, num_packed);
            unpack_cells(exponent, std::as_bytes(packed), count, mesh, all.cells);
        }
        if (in_units) continue;
        for (CellMoments& cell : std::span(all.cells).last(count)) cell.moments.weight *= head[2];
    }
    return all;
}

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

/// Returns half the longest edge of the box around the means. Does not overflow for any
/// coordinates.
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

/// Returns the exponent of the finest lattice on which at most `most` cells are left. The search
/// starts at the edge length with which points that fill a cube have about this number of cells;
/// other points leave most of the lattice empty, and need longer edges.
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
