#include "passes/checked_passes.hpp"

#include "options/rejection.hpp"
#include "passes/open_points.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace rrcb {

namespace {

/// Throws Error if a function of the passes returned `found` items although `wanted` are needed.
void check_length(const char* function, const char* items, std::size_t found, std::size_t wanted) {
    if (found == wanted) return;
    reject("PointPasses::" + std::string(function) + "() returned " + std::to_string(found) + " " +
           items + ", but " + std::to_string(wanted) + " are needed");
}

/// As check_length(), for weights, which may be empty if every point has weight 1.
void check_weights(const char* function, std::size_t found, std::size_t num_points) {
    if (found > 0) check_length(function, "weights of points", found, num_points);
}

void check_totals(const char* function, const PartTotals& totals, int num_parts) {
    const auto wanted = static_cast<std::size_t>(num_parts);
    check_length(function, "weights of parts", totals.weights.size(), wanted);
    check_length(function, "counts of parts", totals.counts.size(), wanted);
}

void check_collected(const char* function, const Collected& collected, int dimension,
                     int num_parts) {
    check_length(function, "axes", static_cast<std::size_t>(collected.dimension),
                 static_cast<std::size_t>(dimension));
    check_length(function, "coordinates", collected.coordinates.size(),
                 collected.count() * static_cast<std::size_t>(dimension));
    check_weights(function, collected.weights.size(), collected.count());
    check_totals(function, collected.settled, num_parts);
}

/// Throws Error if cells are not in ascending order, or if points are missing in them. Points of
/// weight 0 may be missing.
void check_cells(std::span<const CellMoments> cells, const SupportMesh& mesh,
                 const PointSummary& points, bool are_counted) {
    constexpr double round_off = 1e-6;
    const LocalIndex end = num_cells(mesh);
    LocalIndex first = 0;
    double share = 0;
    for (const auto& [cell, box, moments] : cells) {
        if (cell < first || cell >= end)
            reject("PointPasses::moments() returned cell " + std::to_string(cell) +
                   " of a mesh of " + std::to_string(end) +
                   " cells; return cells of the mesh in ascending order, each once");
        first = cell + 1;
        share += are_counted
                     ? static_cast<double>(moments.count) / static_cast<double>(points.count)
                     : moments.weight / points.weight;
    }
    if (std::abs(share - 1) > round_off && (are_counted || std::isfinite(points.weight)))
        reject("PointPasses::moments() returned " + std::to_string(cells.size()) + " cells with " +
               std::to_string(share) + " times the " + (are_counted ? "number" : "weight") +
               " of the points; return every cell with weight, and all points in it");
}

}  // namespace

void CheckedPasses::use_weights(bool are_used) {
    given_.use_weights(are_used);
    are_weights_used_ = are_used;
}

PointSummary CheckedPasses::summary(bool reads_positions) {
    PointSummary summary = given_.summary(reads_positions);
    check_length("summary", "as the count of points", summary.count, count());
    summary_ = summary;
    return summary;
}

PointSample CheckedPasses::sample(LocalIndex size) {
    PointSample sample = given_.sample(size);
    check_length("sample", "positions", sample.positions.size(), std::min(size, count()));
    check_weights("sample", sample.weights.size(), sample.positions.size());
    return sample;
}

std::vector<CellMoments> CheckedPasses::moments(const SupportMesh& mesh) {
    std::vector<CellMoments> cells = given_.moments(mesh);
    check_cells(cells, mesh, summary_,
                !are_weights_used_ || summary_.lightest == summary_.heaviest);
    return cells;
}

PartTotals CheckedPasses::assign(const Cuts& cuts, bool counts) {
    PartTotals totals = given_.assign(cuts, counts);
    if (counts) check_totals("assign", totals, cuts.num_parts);
    return totals;
}

std::unique_ptr<OpenPoints> CheckedPasses::open(const Cuts& cuts,
                                                std::span<const Bracket> intervals,
                                                bool has_parts) {
    return given_.open(cuts, intervals, has_parts);
}

void CheckedPasses::collect(const Cuts& cuts, std::span<const Bracket> intervals, bool has_parts,
                            Collected& collected) {
    given_.collect(cuts, intervals, has_parts, collected);
    check_collected("collect", collected, dimension(), cuts.num_parts);
}

std::vector<std::size_t> CheckedPasses::collect_more(std::span<const Wanted> wanted,
                                                     Collected& collected) {
    const LocalIndex num_before = collected.count();
    const auto num_parts = static_cast<int>(collected.settled.counts.size());
    std::vector<std::size_t> nodes = given_.collect_more(wanted, collected);
    check_collected("collect_more", collected, dimension(), num_parts);
    check_length("collect_more", "nodes of points", nodes.size(), collected.count() - num_before);
    const auto bad = std::ranges::find_if(nodes, [&](std::size_t k) { return k >= wanted.size(); });
    if (bad != nodes.end())
        reject("PointPasses::collect_more() returned node " + std::to_string(*bad) + " of " +
               std::to_string(wanted.size()) + " for a point; nodes are numbered from 0");
    return nodes;
}

std::vector<Box> CheckedPasses::boxes(int num_parts) {
    std::vector<Box> boxes = given_.boxes(num_parts);
    check_length("boxes", "boxes", boxes.size(), static_cast<std::size_t>(num_parts));
    return boxes;
}

std::vector<Part> CheckedPasses::parts() const {
    std::vector<Part> parts = given_.parts();
    check_length("parts", "parts", parts.size(), count());
    return parts;
}

}  // namespace rrcb
