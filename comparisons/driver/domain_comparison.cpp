#include "domain_comparison.hpp"

#include "gather/lean_cells.hpp"

#include <rrcb/method/bisection.hpp>
#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>

namespace comparisons {

namespace {

using rrcb::CellMoments;
using rrcb::Points;
using rrcb::StatisticalDomain;
using rrcb::SupportMesh;

SupportMesh mesh_over(const Points& points, int cells_per_axis) {
    return rrcb::make_support_mesh(rrcb::bounding_box(points), points.dimension, cells_per_axis);
}

/// Moments as lean records bring them to the root.
std::vector<CellMoments> lean_cells(const Points& points, const SupportMesh& mesh) {
    const std::vector<CellMoments> cells = rrcb::cell_moments(points, mesh);
    const rrcb::LeanCells packed = rrcb::pack_cells(cells, mesh);
    std::vector<CellMoments> lean;
    rrcb::unpack_cells(packed, packed.bytes, cells.size(), mesh, lean);
    return lean;
}

/// A uniform patch in mean +- sqrt(3) sigma per cell, wherever the cell ends.
StatisticalDomain boxes(const Points& points, int cells_per_axis) {
    StatisticalDomain domain{points.dimension};
    for (const CellMoments& cell : rrcb::cell_moments(points, mesh_over(points, cells_per_axis))) {
        rrcb::Patch patch{{}, {}, cell.moments.weight};
        for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a) {
            patch.lower[a] = cell.moments.mean[a] - std::sqrt(3.0) * cell.moments.deviation[a];
            patch.upper[a] = cell.moments.mean[a] + std::sqrt(3.0) * cell.moments.deviation[a];
        }
        domain.patches.push_back(patch);
    }
    return domain;
}

StatisticalDomain analytic(const Points& points, int cells_per_axis) {
    return rrcb::analytic_domain(lean_cells(points, mesh_over(points, cells_per_axis)),
                                 points.dimension, rrcb::bounding_box(points));
}

StatisticalDomain counts(const Points& points, int cells_per_axis) {
    StatisticalDomain domain{points.dimension};
    for (const CellMoments& cell : rrcb::cell_moments(points, mesh_over(points, cells_per_axis)))
        domain.patches.push_back({cell.box.lower, cell.box.upper, cell.moments.weight, {}, {}});
    return domain;
}

/// The paper's: as many points as there are, in 1.5 sigma.
StatisticalDomain samples(const Points& points, int cells_per_axis) {
    StatisticalDomain domain{points.dimension, {}};
    for (const auto& [position, weight] :
         rrcb::sample_points(rrcb::cell_moments(points, mesh_over(points, cells_per_axis)),
                             points.dimension, rrcb::PaperOptions()))
        domain.patches.push_back({position, position, weight});
    return domain;
}

int sub_cells_per_axis(int dimension) {
    return dimension == 2 ? 8 : 4;
}

StatisticalDomain floor_of(const Points& points, int cells_per_axis) {
    return counts(points, cells_per_axis * sub_cells_per_axis(points.dimension));
}

constexpr int bytes_of_count = 4;
constexpr int num_sub_cells = 64;  // in 2-D and in 3-D

int full_record(int dimension) {
    return 8 * (3 + 2 * dimension);
}

int lean_record(int dimension) {
    return bytes_of_count + 2 * dimension;
}

int count_record(int) {
    return bytes_of_count;
}

int floor_record(int) {
    return bytes_of_count * num_sub_cells;
}

/// Cells per axis for as many bytes as lean records of a mesh take. The floor is that of the cells
/// of lean records.
int cells_for(const DomainMaker& maker, int lean_cells_per_axis, int dimension) {
    if (maker.bytes_per_cell == floor_record) return lean_cells_per_axis;
    const double ratio =
        static_cast<double>(lean_record(dimension)) / maker.bytes_per_cell(dimension);
    const double cells = lean_cells_per_axis * std::pow(ratio, 1.0 / dimension);
    return std::max(1, static_cast<int>(std::lround(cells)));
}

double measured_imbalance(const Points& points, const StatisticalDomain& domain, int num_parts) {
    const rrcb::Cuts cuts = rrcb::bisect(domain, num_parts, {}).cuts;
    std::vector<rrcb::Part> parts(points.count);
    rrcb::assign(cuts, points, parts);
    std::vector<double> weights(static_cast<std::size_t>(num_parts));
    for (rrcb::LocalIndex i = 0; i < points.count; ++i)
        weights[static_cast<std::size_t>(parts[i])] += points.weight(i);
    return rrcb::imbalance(weights);
}

struct Case {
    std::string cloud;
    int dimension = 0;
    int num_parts = 0;
    std::string kind;
    int bytes_per_cell = 0;
    double cells = 0;
    double imbalance = 0;
};

Row row_of(const Case& measured) {
    return Row()
        .add("cloud", measured.cloud)
        .add("dim", measured.dimension)
        .add("parts", measured.num_parts)
        .add("kind", measured.kind)
        .add("bytes_per_cell", measured.bytes_per_cell)
        .add("cells", measured.cells)
        .add("root_bytes_in", measured.bytes_per_cell * measured.cells)
        .add("imbalance", measured.imbalance);
}

std::vector<int> lean_meshes(int dimension, bool quick) {
    if (quick) return {dimension == 2 ? 16 : 6};
    return dimension == 2 ? std::vector{8, 16, 32} : std::vector{4, 7, 12};
}

}  // namespace

const std::vector<DomainMaker>& domain_makers() {
    static const std::vector<DomainMaker> makers = {
        {"box", full_record, boxes},       {"analytic", lean_record, analytic},
        {"counts", count_record, counts},  {"samples", full_record, samples},
        {"floor", floor_record, floor_of},
    };
    return makers;
}

std::vector<Row> domain_rows(const DomainCase& points, bool quick) {
    std::vector<Row> rows;
    const int dimension = points.dimension;
    for (const int mesh : lean_meshes(dimension, quick)) {
        for (const DomainMaker& maker : domain_makers()) {
            const int per_axis = cells_for(maker, mesh, dimension);
            const StatisticalDomain domain = maker.make(points.points(), per_axis);
            for (const int num_parts : {8, 64, 256})
                rows.push_back(
                    row_of({points.cloud, dimension, num_parts, maker.name,
                            maker.bytes_per_cell(dimension), std::pow(per_axis, dimension),
                            measured_imbalance(points.points(), domain, num_parts)}));
        }
    }
    return rows;
}

Row domain_columns() {
    return row_of({});
}

}  // namespace comparisons
