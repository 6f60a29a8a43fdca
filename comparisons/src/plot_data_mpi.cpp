#include "plot_data_mpi.hpp"

#include "bisection/domain_kinds.hpp"
#include "layout_mpi.hpp"
#include "text.hpp"
#include "zoltan_partitioner_mpi.hpp"

#include <rrcb/rrcb.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace comparisons {

namespace {

using rrcb::GlobalCount;
using Rows = std::vector<double>;

constexpr GlobalCount max_plotted = 60'000;
constexpr const char axis_names[] = {'x', 'y', 'z'};

/// Rows of all ranks, in the order of the ranks, on rank 0.
Rows gather(const Rows& mine, MPI_Comm comm) {
    int size = 0;
    MPI_Comm_size(comm, &size);
    const int length = static_cast<int>(mine.size());
    std::vector<int> lengths(static_cast<std::size_t>(size));
    MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, comm);
    std::vector<int> starts(lengths.size());
    std::exclusive_scan(lengths.begin(), lengths.end(), starts.begin(), 0);
    Rows all(static_cast<std::size_t>(starts.back() + lengths.back()));
    MPI_Gatherv(mine.data(), length, MPI_DOUBLE, all.data(), lengths.data(), starts.data(),
                MPI_DOUBLE, 0, comm);
    return all;
}

void write_rows(std::ostream& out, const std::string& heading, const Rows& rows) {
    const auto width = static_cast<std::size_t>(std::ranges::count(heading, ',') + 1);
    out << heading << '\n';
    for (std::size_t i = 0; i < rows.size(); ++i) {
        out << rows[i] << (i % width == width - 1 ? '\n' : ',');
    }
}

std::string data_file(const std::string& kind, const Workload& workload,
                      const std::string& method = {}) {
    return "data/" + kind + '_' + file_name_part(workload.name) +
           (method.empty() ? "" : '_' + file_name_part(method)) + ".csv";
}

/// "prefix_x,prefix_y" of as many axes as there are.
std::string axis_columns(const std::string& prefix, int dimension) {
    std::string columns;
    for (int a = 0; a < dimension; ++a) {
        columns += (a == 0 ? "" : ",") + prefix + axis_names[a];
    }
    return columns;
}

std::string box_columns(int dimension) {
    return axis_columns("lower_", dimension) + ',' + axis_columns("upper_", dimension);
}

void append(Rows& rows, const rrcb::Vector& values, int dimension) {
    rows.insert(rows.end(), values.begin(), values.begin() + dimension);
}

/// Every how many points one is plotted, and where this rank starts.
struct Thinning {
    std::size_t first = 0;
    std::size_t stride = 1;
};

Thinning thin_out(std::size_t count, MPI_Comm comm) {
    const auto mine = static_cast<GlobalCount>(count);
    GlobalCount total = 0;
    GlobalCount end = 0;
    MPI_Allreduce(&mine, &total, 1, MPI_INT64_T, MPI_SUM, comm);
    MPI_Scan(&mine, &end, 1, MPI_INT64_T, MPI_SUM, comm);
    const GlobalCount stride = std::max<GlobalCount>(1, (total + max_plotted - 1) / max_plotted);
    const GlobalCount begin = end - mine;
    return {static_cast<std::size_t>((stride - begin % stride) % stride),
            static_cast<std::size_t>(stride)};
}

void write_points(const ResultsFolder& folder, const Workload& workload,
                  const Measurement& measurement, MPI_Comm comm) {
    const rrcb::Points points = workload.points();
    const Thinning thinning = thin_out(points.count, comm);
    Rows mine;
    for (std::size_t i = thinning.first; i < points.count; i += thinning.stride) {
        append(mine, points.position(i), workload.dimension);
        mine.push_back(measurement.parts[i]);
    }
    const Rows rows = gather(mine, comm);
    folder.write(data_file("points", workload, measurement.method), [&](std::ostream& out) {
        write_rows(out, axis_columns("", workload.dimension) + ",part", rows);
    });
}

/// Boxes of the parts of a method that cuts along the axes; none of the others.
std::vector<rrcb::Box> part_boxes(const Workload& workload, const Method& method, MPI_Comm comm) {
    int num_parts = 0;
    MPI_Comm_size(comm, &num_parts);
    std::vector<rrcb::Box> boxes;
    if (method.options) {
        const rrcb::Balance balance = rrcb::balance(workload.points(), *method.options, comm);
        for (int p = 0; p < num_parts; ++p) boxes.push_back(rrcb::box_of(balance.cuts, p));
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
    const rrcb::Box cloud = global_box(workload, comm);
    Rows rows;
    for (std::size_t p = 0; p < boxes.size(); ++p) {
        rrcb::Vector lower{};
        rrcb::Vector upper{};
        for (std::size_t a = 0; a < lower.size(); ++a) {
            lower[a] = std::max(boxes[p].lower[a], cloud.lower[a]);
            upper[a] = std::min(boxes[p].upper[a], cloud.upper[a]);
        }
        rows.push_back(static_cast<double>(p));
        append(rows, lower, workload.dimension);
        append(rows, upper, workload.dimension);
    }
    folder.write(data_file("boxes", workload, method.label), [&](std::ostream& out) {
        write_rows(out, "part," + box_columns(workload.dimension), rows);
    });
}

/// Cells of one rank's support mesh, in the columns of data/cells_*.
Rows cell_rows(const std::vector<rrcb::CellMoments>& cells, int dimension, MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    Rows rows;
    for (const rrcb::CellMoments& cell : cells) {
        rows.push_back(rank);
        rows.push_back(static_cast<double>(cell.cell));
        append(rows, cell.box.lower, dimension);
        append(rows, cell.box.upper, dimension);
        append(rows, cell.moments.mean, dimension);
        append(rows, cell.moments.deviation, dimension);
        rows.push_back(static_cast<double>(cell.moments.count));
        rows.push_back(cell.moments.weight);
    }
    return rows;
}

std::vector<rrcb::CellMoments> cells_from(const Rows& rows, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    std::vector<rrcb::CellMoments> cells;
    for (const double* row = rows.data(); row != rows.data() + rows.size(); row += 4 + 4 * d) {
        rrcb::CellMoments cell;
        cell.cell = static_cast<rrcb::LocalIndex>(row[1]);
        std::copy_n(row + 2, d, cell.box.lower.begin());
        std::copy_n(row + 2 + d, d, cell.box.upper.begin());
        std::copy_n(row + 2 + 2 * d, d, cell.moments.mean.begin());
        std::copy_n(row + 2 + 3 * d, d, cell.moments.deviation.begin());
        cell.moments.count = static_cast<GlobalCount>(row[2 + 4 * d]);
        cell.moments.weight = row[3 + 4 * d];
        cells.push_back(cell);
    }
    return cells;
}

void write_sampled(std::ostream& out, const rrcb::StatisticalDomain& domain) {
    const std::size_t stride = std::max<std::size_t>(
        1, (domain.points.size() + max_plotted - 1) / static_cast<std::size_t>(max_plotted));
    Rows rows;
    for (std::size_t i = 0; i < domain.points.size(); i += stride) {
        append(rows, domain.points[i].position, domain.dimension);
    }
    write_rows(out, axis_columns("", domain.dimension), rows);
}

void write_statistics(const ResultsFolder& folder, const Workload& workload,
                      const rrcb::Options& options, MPI_Comm comm) {
    const int dimension = workload.dimension;
    const rrcb::Points points = workload.points();
    std::vector<rrcb::CellMoments> cells;
    if (points.count > 0) {
        cells = rrcb::cell_moments(
            points,
            rrcb::make_support_mesh(rrcb::bounding_box(points), dimension, options.support_mesh));
    }
    const Rows rows = gather(cell_rows(cells, dimension, comm), comm);
    folder.write(data_file("cells", workload), [&](std::ostream& out) {
        write_rows(out,
                   "rank,cell," + box_columns(dimension) + ',' + axis_columns("mean_", dimension) +
                       ',' + axis_columns("sigma_", dimension) + ",count,weight",
                   rows);
    });
    folder.write(data_file("statistical", workload), [&](std::ostream& out) {
        write_sampled(out, rrcb::sampled_domain(cells_from(rows, dimension), dimension, options));
    });
}

/// Dumps may hold points on a line, and points that are nowhere. Collective over `comm`.
bool can_be_drawn(const Workload& workload, MPI_Comm comm) {
    int is_finite =
        std::ranges::all_of(workload.coordinates, [](double x) { return std::isfinite(x); });
    MPI_Allreduce(MPI_IN_PLACE, &is_finite, 1, MPI_INT, MPI_MIN, comm);
    return workload.dimension > 1 && is_finite != 0;
}

/// The first sampled method of the comparison, or the one of the paper.
rrcb::Options sampled_options(std::span<const Method> methods) {
    for (const Method& method : methods) {
        if (method.options && rrcb::traits_of(method.options->domain).is_random) {
            return *method.options;
        }
    }
    return *read_method("rrcb-sampled").options;
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
