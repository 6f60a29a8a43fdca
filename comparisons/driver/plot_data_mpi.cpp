#include "plot_data_mpi.hpp"

#include "failure_mpi.hpp"
#include "partitioner_mpi.hpp"
#include "row.hpp"
#include "text.hpp"
#include "workload_mpi.hpp"

#include <rrcb/detail/paper_steps.hpp>
#include <rrcb/rrcb.hpp>

#include <algorithm>
#include <cmath>

namespace comparisons {

namespace {

using rrcb::GlobalCount;
constexpr GlobalCount max_plotted = 60'000;
constexpr const char axis_names[] = {'x', 'y', 'z'};

std::string data_file(const std::string& kind, const Workload& workload,
                      const std::string& method = {}) {
    return "data/" + kind + '_' + file_name_part(workload.name) +
           (method.empty() ? "" : '_' + file_name_part(method)) + ".csv";
}

/// Adds one column for each axis.
void add_axes(Row& row, const std::string& prefix, const rrcb::Vector& values, int dimension) {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        row.add(prefix + axis_names[a], nine_digits(values[a]));
}

void add_box(Row& row, const rrcb::Box& box, int dimension) {
    add_axes(row, "lower_", box.lower, dimension);
    add_axes(row, "upper_", box.upper, dimension);
}

/// Returns the items of all ranks on rank 0, in the order of the ranks. Collective.
template <typename Item>
std::vector<Item> gather_on_root(const std::vector<Item>& mine, MPI_Comm comm) {
    const std::vector<rrcb::Part> root(mine.size(), 0);
    return rrcb::transfer(rrcb::plan(root, size_of(comm), comm), mine, comm);
}

struct PlottedPoint {
    rrcb::Vector position{};
    rrcb::Part part = 0;
};

/// Writes points at equal distances in the order of all ranks' points, to limit their number.
void write_points(const ResultsFolder& folder, const Workload& workload,
                  const Measurement& measurement, MPI_Comm comm) {
    const rrcb::Points points = workload.points();
    const auto count = static_cast<GlobalCount>(points.count);
    GlobalCount total = 0;
    GlobalCount end = 0;
    MPI_Allreduce(&count, &total, 1, MPI_INT64_T, MPI_SUM, comm);
    MPI_Scan(&count, &end, 1, MPI_INT64_T, MPI_SUM, comm);
    const GlobalCount stride = std::max<GlobalCount>(1, (total + max_plotted - 1) / max_plotted);
    std::vector<PlottedPoint> mine;
    for (GlobalCount i = (stride - (end - count) % stride) % stride; i < count; i += stride) {
        const auto point = static_cast<std::size_t>(i);
        mine.push_back({points.position(point), measurement.parts[point]});
    }
    const std::vector<PlottedPoint> plotted = gather_on_root(mine, comm);
    folder.write(data_file("points", workload, measurement.method), [&] {
        return csv_of(plotted, [&](const PlottedPoint& point) {
            Row row;
            add_axes(row, "", point.position, workload.dimension);
            return row.add("part", point.part);
        });
    });
}

/// Returns the boxes of the parts of a method that cuts along the axes; empty for other methods.
std::vector<rrcb::Box> part_boxes(const Workload& workload, const Method& method, MPI_Comm comm) {
    const int num_parts = size_of(comm);
    std::vector<rrcb::Box> boxes;
    if (method.options) {
        const rrcb::Balance balanced = balance(*method.options, workload.points(), comm);
        for (int p = 0; p < num_parts; ++p) boxes.push_back(rrcb::box_of(balanced.cuts, p));
    } else if (method.lb_method == "RCB") {
        ZoltanParameters parameters = zoltan_parameters(method, Lists::parts);
        parameters.emplace_back("KEEP_CUTS", "1");
        ZoltanPartitioner partitioner(parameters, workload, comm);
        partitioner.partition();
        for (int p = 0; p < num_parts; ++p) boxes.push_back(partitioner.box_of(p));
    }
    return boxes;
}

void write_boxes(const ResultsFolder& folder, const Workload& workload, const Method& method,
                 MPI_Comm comm) {
    const std::vector<rrcb::Box> boxes = part_boxes(workload, method, comm);
    if (boxes.empty()) return;
    const rrcb::Box cloud = joined_box(rrcb::bounding_box(workload.points()), comm);
    folder.write(data_file("boxes", workload, method.label), [&] {
        rrcb::Part part = 0;
        return csv_of(boxes, [&](rrcb::Box box) {
            for (std::size_t a = 0; a < box.lower.size(); ++a) {
                box.lower[a] = std::max(box.lower[a], cloud.lower[a]);
                box.upper[a] = std::min(box.upper[a], cloud.upper[a]);
            }
            Row row;
            row.add("part", part++);
            add_box(row, box, workload.dimension);
            return row;
        });
    });
}

struct RankCell {
    int rank = 0;
    rrcb::CellMoments moments;
};

Row cell_row(const RankCell& of_rank, int dimension) {
    const rrcb::CellMoments& cell = of_rank.moments;
    Row row;
    row.add("rank", of_rank.rank).add("cell", cell.cell);
    add_box(row, cell.box, dimension);
    add_axes(row, "mean_", cell.moments.mean, dimension);
    add_axes(row, "sigma_", cell.moments.deviation, dimension);
    return row.add("count", cell.moments.count).add("weight", nine_digits(cell.moments.weight));
}

std::string statistical_csv(const std::vector<RankCell>& cells, int dimension,
                            const rrcb::PaperOptions& options) {
    std::vector<rrcb::CellMoments> moments;
    for (const RankCell& cell : cells) moments.push_back(cell.moments);
    const std::vector<rrcb::MassPoint> points = rrcb::sample_points(moments, dimension, options);
    const std::size_t stride = std::max<std::size_t>(
        1, (points.size() + max_plotted - 1) / static_cast<std::size_t>(max_plotted));
    std::vector<rrcb::Vector> plotted;
    for (std::size_t i = 0; i < points.size(); i += stride) plotted.push_back(points[i].position);
    return csv_of(plotted, [&](const rrcb::Vector& position) {
        Row row;
        add_axes(row, "", position, dimension);
        return row;
    });
}

void write_statistics(const ResultsFolder& folder, const Workload& workload,
                      const rrcb::PaperOptions& options, MPI_Comm comm) {
    const int dimension = workload.dimension;
    const rrcb::Points points = workload.points();
    RankCell of_rank{rank_of(comm), {}};
    std::vector<RankCell> mine;
    if (points.count > 0) {
        for (const rrcb::CellMoments& cell : rrcb::cell_moments(
                 points, rrcb::make_support_mesh(rrcb::bounding_box(points), dimension,
                                                 options.cells_per_axis))) {
            of_rank.moments = cell;
            mine.push_back(of_rank);
        }
    }
    const std::vector<RankCell> cells = gather_on_root(mine, comm);
    folder.write(data_file("cells", workload), [&] {
        return csv_of(cells, [&](const RankCell& cell) { return cell_row(cell, dimension); });
    });
    folder.write(data_file("statistical", workload),
                 [&] { return statistical_csv(cells, dimension, options); });
}

/// Returns whether a picture can show the points. The points of dumps may be on a line or not
/// finite. Collective over `comm`.
bool can_be_drawn(const Workload& workload, MPI_Comm comm) {
    int is_finite =
        std::ranges::all_of(workload.coordinates, [](double x) { return std::isfinite(x); });
    MPI_Allreduce(MPI_IN_PLACE, &is_finite, 1, MPI_INT, MPI_MIN, comm);
    return workload.dimension > 1 && is_finite != 0;
}

/// Returns the options of the first sampled method, or the default options of the paper's method.
rrcb::PaperOptions sampled_options(std::span<const Method> methods) {
    for (const Method& method : methods) {
        const auto* paper =
            method.options ? std::get_if<rrcb::PaperOptions>(&*method.options) : nullptr;
        if (paper && paper->domain == rrcb::PaperDomain::sampled) return *paper;
    }
    return std::get<rrcb::PaperOptions>(*read_method("rrcb-sampled").options);
}

}  // namespace

void write_plot_data(const ResultsFolder& folder, const Workload& workload,
                     std::span<const Method> methods, std::span<const Measurement> measurements,
                     MPI_Comm comm) {
    if (!can_be_drawn(workload, comm)) return;
    for (std::size_t m = 0; m < methods.size(); ++m) {
        if (!measurements[m].error.empty()) continue;
        write_points(folder, workload, measurements[m], comm);
        write_boxes(folder, workload, methods[m], comm);
    }
    write_statistics(folder, workload, sampled_options(methods), comm);
}

}  // namespace comparisons
