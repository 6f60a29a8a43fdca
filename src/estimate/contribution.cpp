#include "estimate/contribution.hpp"

#include "cuts/cut_limits.hpp"
#include "estimate/cell_records.hpp"
#include "estimate/frame.hpp"

#include <rrcb/method/support_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace rrcb {

namespace {

void join(Box& mine, const Box& next) {
    for (std::size_t a = 0; a < max_dimension; ++a) {
        mine.lower[a] = std::min(mine.lower[a], next.lower[a]);
        mine.upper[a] = std::max(mine.upper[a], next.upper[a]);
    }
}

/// Keeps the first difference in the order of the ranks.
void join_differences(Summary& mine, const Summary& next) {
    if (mine.differing_rank != no_rank) return;
    mine.difference = next.difference;
    mine.differing_rank = next.differing_rank;
    mine.reference_rank = next.reference_rank;
    if (const auto difference = first_difference(mine.request, next.request)) {
        mine.difference = *difference;
        mine.differing_rank = next.first_rank;
        mine.reference_rank = mine.first_rank;
    }
}

void coarsen_records(Contribution& all, int dimension, std::size_t most) {
    const bool is_counted = all.summary.is_counted();
    const CellSet merged = coarsen(read_cells(all.records, dimension, is_counted), dimension, most);
    std::vector<double> records;
    append_cells(merged, dimension, is_counted ? all.summary.heaviest : 1, records);
    all.records = std::move(records);
    all.summary.num_cells = static_cast<std::int64_t>(merged.cells.size());
}

/// Cells per axis with which an estimate errs by about a percent for a few hundred parts.
double fine_cells(int dimension) {
    return dimension == 1 ? 128 : dimension == 2 ? 22 : 10;
}

/// Cells per axis beyond which more cells cost more than they gain, for any number of points.
double most_cells_per_axis(int dimension) {
    return dimension == 1 ? 400 : dimension == 2 ? 42 : 15;
}

/// Returns a mesh whose cells are one or more cells of the grid that limits the cuts: the weight
/// between the lines is then known. Returns nullopt if the numbers do not allow it.
std::optional<SupportMesh> mesh_on_lines(const Box& box, int dimension, const Options& options) {
    SupportMesh mesh = make_support_mesh(box, dimension, 1);
    const auto limits = axis_limits(options);
    for (int a = 0; a < dimension; ++a) {
        if (!limits[a].resolves(std::max(std::abs(box.lower[a]), std::abs(box.upper[a]))))
            return {};
        const double first = limits[a].line_below(box.lower[a]);
        const double num_lines = limits[a].line_below(box.upper[a]) + 1 - first;
        const double together = std::ceil(num_lines / fine_cells(dimension));
        const double cells = std::ceil(num_lines / together);
        mesh.box.lower[a] = limits[a].line(first);
        mesh.box.upper[a] = limits[a].line(first + cells * together);
        const double extent = mesh.box.upper[a] * mesh.scale[a] - mesh.box.lower[a] * mesh.scale[a];
        if (!(extent > 0 && std::isfinite(mesh.box.upper[a]) && std::isfinite(mesh.box.lower[a])))
            return {};
        mesh.cells[a] = static_cast<int>(cells);
        mesh.cells_per_length[a] = cells / extent;
    }
    mesh.frame = mesh.box;
    return mesh;
}

/// Returns true if the points are so few that each is a cell of its own: no more than a few for
/// each part, and than merging leaves, were all ranks to hold as many.
bool are_cells(LocalIndex num_points, int num_ranks, const Options& options) {
    constexpr std::size_t points_per_part = 4;
    const std::size_t most = points_per_part * static_cast<std::size_t>(options.num_parts);
    return options.tuning.support_mesh == 0 &&
           num_points * static_cast<std::size_t>(num_ranks) <= std::min(most, most_cells(options));
}

/// Returns the points as cells of the lattice on which no two of them merge.
CellSet cells_of_points(PointPasses& points) {
    const PointSample all = points.sample(points.count());
    CellSet set;
    for (std::size_t i = 0; i < all.positions.size(); ++i) {
        const double weight = all.weights.empty() ? 1 : all.weights[i];
        set.cells.push_back({0, {}, {1, weight, all.positions[i], {}}});
    }
    set.exponent = last_digit(set.cells, points.dimension());
    return set;
}

/// Returns the support mesh of the options over the box of the points.
SupportMesh mesh_by_options(PointPasses& points, const Box& box, const Options& options) {
    const int dimension = points.dimension();
    const bool is_automatic = options.tuning.support_mesh == 0;
    if (is_automatic && !options.axes.grid.empty())
        if (const auto mesh = mesh_on_lines(box, dimension, options)) return *mesh;
    const int cells = is_automatic ? automatic_cells_per_axis(dimension, points.count(), options)
                                   : options.tuning.support_mesh;
    return make_framed_mesh(points, box, cells);
}

}  // namespace

int automatic_cells_per_axis(int dimension, LocalIndex num_points, const Options& options) {
    constexpr double least_points_per_cell = 16;
    constexpr double points_per_cell = 800;
    constexpr double least_cells = 64;
    constexpr double cells_per_part = 16;
    const auto count = static_cast<double>(num_points);
    const auto per_axis = [&](double cells) { return std::pow(cells, 1.0 / dimension); };
    const double by_parts = per_axis(std::max(least_cells, cells_per_part * options.num_parts));
    const double by_points = per_axis(count / points_per_cell);
    const double usual = std::max(by_points, std::min(by_parts, fine_cells(dimension)));
    const double filled = per_axis(count / least_points_per_cell);
    const double cells = std::min({most_cells_per_axis(dimension), usual, filled});
    // The root of a cube may be rounded to below the whole number.
    constexpr double above_rounding = 1 + 1e-12;
    return static_cast<int>(std::max(1.0, std::floor(cells * above_rounding)));
}

Summary summarize(const PointSummary& points, bool are_weighted, int rank) {
    Summary summary;
    summary.box = points.box;
    summary.num_points = static_cast<std::int64_t>(points.count);
    summary.weight = points.weight;
    summary.lightest = points.lightest;
    summary.heaviest = points.heaviest;
    if (summary.num_points > 0)
        (are_weighted ? summary.weighted_rank : summary.unweighted_rank) = rank;
    return summary;
}

void add_records(PointPasses& points, const Box& box, int num_ranks, const Options& options,
                 Contribution& mine) {
    if (points.count() == 0) return;
    const Summary& summary = mine.summary;
    points.use_weights(!summary.is_counted());
    const double unit = summary.is_counted() ? summary.heaviest : 1;
    if (are_cells(points.count(), num_ranks, options)) {
        append_cells(cells_of_points(points), points.dimension(), unit, mine.records);
        mine.summary.num_cells = summary.num_points;
        return;
    }
    const SupportMesh mesh = mesh_by_options(points, box, options);
    const std::vector<CellMoments> cells = points.moments(mesh);
    append_lean_cells(cells, mesh, unit, mine.records);
    mine.summary.num_cells = static_cast<std::int64_t>(cells.size());
}

void add_totals(const PartTotals& totals, const NearShare& near, Contribution& mine) {
    mine.part_totals = totals.weights;
    mine.part_totals.insert(mine.part_totals.end(), totals.counts.begin(), totals.counts.end());
    if (totals.counts.empty()) return;
    mine.part_totals.push_back(near.by_weight * mine.summary.weight);
    const auto count = static_cast<double>(mine.summary.num_points);
    mine.part_totals.push_back(near.by_count * count);
    for (const double spread : near.spread) mine.part_totals.push_back(spread * count);
}

std::size_t most_cells(const Options& options) {
    constexpr std::size_t most = 8192;
    return options.tuning.support_mesh == 0 ? most : std::numeric_limits<std::size_t>::max();
}

void join(Summary& mine, const Summary& next) {
    if (mine.failing_rank == no_rank) mine.failing_rank = next.failing_rank;
    join_differences(mine, next);
    if (mine.weighted_rank == no_rank) mine.weighted_rank = next.weighted_rank;
    if (mine.unweighted_rank == no_rank) mine.unweighted_rank = next.unweighted_rank;
    join(mine.box, next.box);
    mine.num_points += next.num_points;
    mine.num_cells += next.num_cells;
    mine.weight += next.weight;
    mine.lightest = std::min(mine.lightest, next.lightest);
    mine.heaviest = std::max(mine.heaviest, next.heaviest);
}

void absorb(Contribution& mine, const Summary& next, int dimension, std::size_t most) {
    const auto first_total = mine.records.end() - next.num_total_doubles;
    // Other lengths come from a rank with other options.
    if (std::ssize(mine.part_totals) == next.num_total_doubles)
        std::transform(first_total, mine.records.end(), mine.part_totals.begin(),
                       mine.part_totals.begin(), std::plus<>());
    mine.records.erase(first_total, mine.records.end());
    const auto first_place = mine.records.end() - next.num_extent_doubles;
    mine.extents.insert(mine.extents.end(), first_place, mine.records.end());
    mine.records.erase(first_place, mine.records.end());
    join(mine.summary, next);
    if (!mine.summary.is_usable()) mine.records.clear();
    const auto num_cells = static_cast<std::size_t>(mine.summary.num_cells);
    const std::size_t full_doubles = 3 + 2 * dimension;
    const bool too_many = num_cells / 2 > most || mine.records.size() / full_doubles > most;
    if (too_many && mine.summary.is_usable()) coarsen_records(mine, dimension, most);
}

StatisticalDomain build_domain(const Contribution& all, int dimension) {
    const CellSet set = read_cells(all.records, dimension, all.summary.is_counted());
    return analytic_domain(set.cells, dimension, all.summary.box);
}

}  // namespace rrcb
