#include "contribution.hpp"

#include <rrcb/error.hpp>
#include <rrcb/support_mesh.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

std::uint64_t hash_of(std::span<const double> values) {
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (const double value : values) {
        for (int byte = 0; byte < 8; ++byte) {
            hash ^= std::bit_cast<std::uint64_t>(value) >> (8 * byte) & 0xff;
            hash *= 1099511628211u;
        }
    }
    return hash;
}

std::vector<double> axis_options(const Options& options) {
    std::vector<double> values{options.plain_cuts ? 1.0 : 0.0};
    values.insert(values.end(), options.grouped_axes.begin(), options.grouped_axes.end());
    values.push_back(-1);
    values.insert(values.end(), options.cut_axes.begin(), options.cut_axes.end());
    return values;
}

std::vector<double> values_of(const Cuts& cuts) {
    std::vector<double> values;
    for (const Cut& cut : cuts.tree) {
        values.push_back(cut.axis);
        values.insert(values.end(), cut.at.begin(), cut.at.end());
    }
    return values;
}

std::int64_t moments_length(int dimension) {
    return 3 + 2 * dimension;
}

/// Record of a cell: number, count, weight, mean and deviation per axis.
void append_moments(const CellMoments& cell, int dimension, std::vector<double>& records) {
    records.push_back(static_cast<double>(cell.cell));
    records.push_back(static_cast<double>(cell.moments.count));
    records.push_back(cell.moments.weight);
    const auto d = static_cast<std::ptrdiff_t>(dimension);
    records.insert(records.end(), cell.moments.mean.begin(), cell.moments.mean.begin() + d);
    records.insert(records.end(), cell.moments.deviation.begin(),
                   cell.moments.deviation.begin() + d);
}

CellMoments read_moments(std::span<const double> record, const SupportMesh& mesh) {
    CellMoments cell;
    const auto d = static_cast<std::size_t>(mesh.dimension);
    cell.cell = static_cast<LocalIndex>(record[0]);
    cell.box = cell_box(mesh, cell.cell);
    cell.moments.count = static_cast<GlobalCount>(record[1]);
    cell.moments.weight = record[2];
    std::copy_n(record.begin() + 3, d, cell.moments.mean.begin());
    std::copy_n(record.begin() + 3 + static_cast<std::ptrdiff_t>(d), d,
                cell.moments.deviation.begin());
    return cell;
}

/// Coordinates of all points, then their weights if they have any.
std::vector<double> point_records(const Points& points) {
    std::vector<double> records;
    for (LocalIndex i = 0; i < points.count; ++i)
        for (int a = 0; a < points.dimension; ++a) records.push_back(points.coordinate(i, a));
    records.insert(records.end(), points.weights.begin(), points.weights.end());
    return records;
}

/// What the options ask for, which must be the same on every rank.
Header header_of(const Options& options, int dimension, const Cuts* previous) {
    Header header;
    header.dimension = dimension;
    header.num_parts = options.num_parts;
    header.support_mesh = options.support_mesh;
    header.domain = static_cast<std::int32_t>(options.domain);
    header.cut_rule = static_cast<std::int32_t>(options.cut_rule);
    header.refine = static_cast<std::int32_t>(options.refine);
    header.imbalance_tolerance = options.imbalance_tolerance;
    header.sigma_multiplier = options.sigma_multiplier;
    header.sample_fraction = options.sample_fraction;
    header.seed = options.seed;
    header.part_sizes_hash = hash_of(options.part_sizes);
    header.axes_hash = hash_of(axis_options(options));
    header.previous_hash = previous ? hash_of(values_of(*previous)) : 0;
    return header;
}

double heaviest_of(const Points& points) {
    if (points.count == 0) return 0;
    return points.weights.empty() ? 1 : *std::ranges::max_element(points.weights);
}

/// Calls `visit(header, record)` for each record of all ranks.
template <class Visit>
void visit_records(std::span<const Header> headers, std::span<const double> records,
                   Visit&& visit) {
    for (const Header& header : headers) {
        const auto length = static_cast<std::size_t>(header.record_length);
        for (std::int64_t k = 0; k < header.num_records; ++k, records = records.subspan(length))
            visit(header, records.first(length));
    }
}

StatisticalDomain points_as_domain(std::span<const Header> headers,
                                   std::span<const double> records) {
    StatisticalDomain all{headers[0].dimension, {}};
    double weight = 0;
    for (const Header& header : headers) {
        const auto length = static_cast<std::size_t>(header.num_records * header.record_length);
        const auto num_coordinates =
            static_cast<std::size_t>(header.num_records * header.dimension);
        const std::span<const double> mine = records.first(length);
        const StatisticalDomain domain = point_domain(interleaved_points(
            mine.first(num_coordinates), header.dimension, mine.subspan(num_coordinates)));
        all.patches.insert(all.patches.end(), domain.patches.begin(), domain.patches.end());
        for (const Patch& patch : domain.patches) weight += patch.weight;
        records = records.subspan(length);
    }
    if (weight == 0)
        for (Patch& patch : all.patches) patch.weight = 1;
    return all;
}

std::vector<CellMoments> all_cells(std::span<const Header> headers,
                                   std::span<const double> records) {
    std::vector<CellMoments> cells;
    const Header* owner = nullptr;
    SupportMesh mesh;
    visit_records(headers, records, [&](const Header& header, std::span<const double> record) {
        if (&header != owner)
            mesh = make_support_mesh(header.box, header.dimension, header.cells_per_axis);
        owner = &header;
        cells.push_back(read_moments(record, mesh));
    });
    return cells;
}

}  // namespace

int automatic_cells_per_axis(int dimension, LocalIndex num_points, int num_ranks) {
    constexpr double points_per_cell = 16;
    constexpr double most_cells_at_root = 1 << 20;
    const double most = dimension == 1 ? 64 : dimension == 2 ? 16 : 8;
    const double cells =
        std::min(static_cast<double>(num_points) / points_per_cell, most_cells_at_root / num_ranks);
    return static_cast<int>(std::clamp(std::floor(std::pow(cells, 1.0 / dimension)), 1.0, most));
}

Contribution contribute(const Points& points, const Box& box, const Options& options,
                        const Cuts* previous, int num_ranks) {
    Contribution mine;
    Header& header = mine.header;
    header = header_of(options, points.dimension, previous);
    header.box = box;
    header.num_points = static_cast<std::int64_t>(points.count);
    header.weight = points.weights.empty()
                        ? static_cast<double>(points.count)
                        : std::accumulate(points.weights.begin(), points.weights.end(), 0.0);
    header.heaviest = heaviest_of(points);
    header.cells_per_axis =
        options.support_mesh > 0
            ? options.support_mesh
            : automatic_cells_per_axis(points.dimension, points.count, num_ranks);
    if (options.domain == DomainKind::points) {
        header.record_length = points.dimension + (points.weights.empty() ? 0 : 1);
        mine.records = point_records(points);
    } else {
        header.record_length = moments_length(points.dimension);
        mine.points =
            sort_by_cell(points, make_support_mesh(box, points.dimension, header.cells_per_axis));
        if (previous == nullptr)
            for (const CellMoments& cell : cell_moments(mine.points))
                append_moments(cell, points.dimension, mine.records);
    }
    header.num_records = static_cast<std::int64_t>(mine.records.size()) / header.record_length;
    return mine;
}

std::optional<std::string> difference_between(std::span<const Header> headers) {
    const Header& root = headers[0];
    for (std::size_t rank = 1; rank < headers.size(); ++rank) {
        const Header& other = headers[rank];
        const auto differs = [&](const char* name) {
            return std::string(name) + " differs between rank 0 and rank " + std::to_string(rank) +
                   "; give the same value on every rank";
        };
        if (other.dimension != root.dimension) return differs("dimension");
        if (other.num_parts != root.num_parts) return differs("num_parts");
        if (other.part_sizes_hash != root.part_sizes_hash) return differs("part_sizes");
        if (other.support_mesh != root.support_mesh) return differs("support_mesh");
        if (other.domain != root.domain) return differs("domain");
        if (other.cut_rule != root.cut_rule) return differs("cut_rule");
        if (other.axes_hash != root.axes_hash)
            return differs("one of grouped_axes, cut_axes, plain_cuts");
        if (other.previous_hash != root.previous_hash) return differs("previous");
        if (other.refine != root.refine) return differs("refine");
        if (other.imbalance_tolerance != root.imbalance_tolerance)
            return differs("imbalance_tolerance");
        if (other.sigma_multiplier != root.sigma_multiplier) return differs("sigma_multiplier");
        if (other.sample_fraction != root.sample_fraction) return differs("sample_fraction");
        if (other.seed != root.seed) return differs("seed");
    }
    return std::nullopt;
}

StatisticalDomain build_domain(std::span<const Header> headers, std::span<const double> records,
                               const Options& options) {
    if (options.domain == DomainKind::points) return points_as_domain(headers, records);
    const std::vector<CellMoments> cells = all_cells(headers, records);
    const int dimension = headers[0].dimension;
    return options.domain == DomainKind::analytic ? analytic_domain(cells, dimension)
                                                  : sampled_domain(cells, dimension, options);
}

}  // namespace rrcb
