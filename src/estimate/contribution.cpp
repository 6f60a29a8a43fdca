#include "estimate/contribution.hpp"

#include "estimate/cell_records.hpp"
#include "estimate/mesh.hpp"

#include <algorithm>
#include <functional>

namespace rrcb {

namespace {

void join(Box& mine, const Box& next) {
    for (std::size_t a = 0; a < max_dimension; ++a) {
        mine.lower[a] = std::min(mine.lower[a], next.lower[a]);
        mine.upper[a] = std::max(mine.upper[a], next.upper[a]);
    }
}

/// Keeps the first difference in order of ranks.
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

/// Returns true if the points are so few that each one is sent as a cell. If all ranks had as many
/// points, there would be at most a few for each part, and no more than merging leaves.
bool are_cells(LocalIndex num_points, int num_ranks, const Options& options) {
    constexpr std::size_t points_per_part = 4;
    const std::size_t most = points_per_part * static_cast<std::size_t>(options.num_parts);
    return options.expert.cells_per_axis == 0 &&
           num_points * static_cast<std::size_t>(num_ranks) <= std::min(most, most_cells(options));
}

/// Returns the points as cells of a lattice that is so fine that no two different positions merge.
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

}  // namespace

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

std::size_t most_cells(const Options& options) {
    constexpr std::size_t most = 8192;
    return options.expert.cells_per_axis == 0 ? most : std::numeric_limits<std::size_t>::max();
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

void absorb(Contribution& mine, const Summary& next, std::span<const double> doubles, int dimension,
            std::size_t most) {
    const std::span<const double> totals = doubles.last(next.num_total_doubles);
    const auto before = doubles.first(doubles.size() - totals.size());
    const std::span<const double> extents = before.last(next.num_extent_doubles);
    const auto cells = before.first(before.size() - extents.size());
    // A different length means that the rank has other options; that is reported later.
    if (mine.part_totals.size() == totals.size())
        std::ranges::transform(totals, mine.part_totals, mine.part_totals.begin(), std::plus<>());
    mine.extents.insert(mine.extents.end(), extents.begin(), extents.end());
    mine.records.insert(mine.records.end(), cells.begin(), cells.end());
    join(mine.summary, next);
    if (!mine.summary.is_usable()) return mine.records.clear();
    const auto num_cells = static_cast<std::size_t>(mine.summary.num_cells);
    const std::size_t full_doubles = 3 + 2 * dimension;
    if (num_cells / 2 > most || mine.records.size() / full_doubles > most)
        coarsen_records(mine, dimension, most);
}

StatisticalDomain build_domain(const Contribution& all, int dimension) {
    const CellSet set = read_cells(all.records, dimension, all.summary.is_counted());
    return analytic_domain(set.cells, dimension, all.summary.box);
}

}  // namespace rrcb
