#include "workload_mpi.hpp"

#include "counter_random.hpp"
#include "failure_mpi.hpp"
#include "points_files.hpp"

#include <rrcb/transfer.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <tuple>
#include <utility>

namespace comparisons {

namespace {

using Axes = std::array<std::uint32_t, rrcb::max_dimension>;

Axes grid_cell(const rrcb::Box& box, const rrcb::Vector& position, int dimension, int bits) {
    Axes cell{};
    const double cells = std::ldexp(1, bits);
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
        const double extent = box.upper[a] - box.lower[a];
        const double place = extent > 0 ? (position[a] - box.lower[a]) / extent * cells : 0;
        cell[a] = static_cast<std::uint32_t>(std::clamp(place, 0.0, cells - 1));
    }
    return cell;
}

void transpose_to_hilbert(Axes& x, int dimension, int bits) {
    const auto n = static_cast<std::size_t>(dimension);
    const std::uint32_t top = 1U << (bits - 1);
    for (std::uint32_t q = top; q > 1; q >>= 1) {
        for (std::size_t i = 0; i < n; ++i) {
            if ((x[i] & q) != 0) {
                x[0] ^= q - 1;
            } else {
                const std::uint32_t t = (x[0] ^ x[i]) & (q - 1);
                x[0] ^= t;
                x[i] ^= t;
            }
        }
    }
    for (std::size_t i = 1; i < n; ++i) x[i] ^= x[i - 1];
    std::uint32_t t = 0;
    for (std::uint32_t q = top; q > 1; q >>= 1) {
        if ((x[n - 1] & q) != 0) t ^= q - 1;
    }
    for (std::size_t i = 0; i < n; ++i) x[i] ^= t;
}

using rrcb::GlobalCount;

std::vector<std::size_t> curve_places(const Workload& workload, MPI_Comm comm) {
    const rrcb::Points points = workload.points();
    const rrcb::Box box = joined_box(rrcb::bounding_box(points), comm);
    std::vector<std::size_t> places(points.count);
    for (std::size_t i = 0; i < points.count; ++i) {
        places[i] = hilbert_cell(box, points.position(i), workload.dimension,
                                 hilbert_bits(workload.dimension));
    }
    return places;
}

/// Returns the rank of each point if the curve is cut into pieces with equal numbers of points.
/// Points in the same cell of the curve keep their order.
std::vector<int> sorted_ranks(const std::vector<std::size_t>& places, std::size_t num_cells,
                              MPI_Comm comm) {
    const int size = size_of(comm);
    std::vector<GlobalCount> mine(num_cells);
    for (const std::size_t place : places) ++mine[place];
    std::vector<GlobalCount> all(num_cells);
    std::vector<GlobalCount> next(num_cells);
    const int length = static_cast<int>(num_cells);
    MPI_Allreduce(mine.data(), all.data(), length, MPI_INT64_T, MPI_SUM, comm);
    MPI_Scan(mine.data(), next.data(), length, MPI_INT64_T, MPI_SUM, comm);
    GlobalCount before = 0;
    for (std::size_t c = 0; c < num_cells; ++c) {
        next[c] += before - mine[c];
        before += all[c];
    }
    std::vector<int> ranks(places.size());
    std::ranges::transform(places, ranks.begin(), [&](std::size_t place) {
        return static_cast<int>(next[place]++ * size / before);
    });
    return ranks;
}

std::vector<int> random_ranks(std::size_t count, std::uint64_t seed, MPI_Comm comm) {
    const int size = size_of(comm);
    auto first = static_cast<GlobalCount>(count);
    MPI_Scan(MPI_IN_PLACE, &first, 1, MPI_INT64_T, MPI_SUM, comm);
    first -= static_cast<GlobalCount>(count);
    std::vector<int> ranks(count);
    constexpr std::uint64_t other_than_the_points = 0x5ca77e2;
    for (std::size_t i = 0; i < count; ++i) {
        CounterRandom random(seed ^ other_than_the_points, static_cast<std::uint64_t>(first) + i);
        ranks[i] = static_cast<int>(random.next() % static_cast<std::uint64_t>(size));
    }
    return ranks;
}

void reorder(Workload& workload, const std::vector<std::size_t>& places) {
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places[i]; });
    const auto dimension = static_cast<std::size_t>(workload.dimension);
    const Workload old = workload;
    for (std::size_t i = 0; i < order.size(); ++i) {
        std::copy_n(&old.coordinates[order[i] * dimension], dimension,
                    &workload.coordinates[i * dimension]);
        if (workload.weighted) workload.weights[i] = old.weights[order[i]];
    }
}

}  // namespace

std::size_t hilbert_cell(const rrcb::Box& box, const rrcb::Vector& position, int dimension,
                         int bits) {
    Axes x = grid_cell(box, position, dimension, bits);
    transpose_to_hilbert(x, dimension, bits);
    std::size_t place = 0;
    for (int bit = bits - 1; bit >= 0; --bit) {
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
            place = place << 1 | (x[a] >> bit & 1U);
        }
    }
    return place;
}

rrcb::Box joined_box(rrcb::Box mine, MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, mine.lower.data(), 3, MPI_DOUBLE, MPI_MIN, comm);
    MPI_Allreduce(MPI_IN_PLACE, mine.upper.data(), 3, MPI_DOUBLE, MPI_MAX, comm);
    return mine;
}

const char* layout_name(Layout layout) {
    return layout == Layout::sorted ? "sorted" : "scattered";
}

namespace {

/// Sends each point to its rank. The points arrive in the order of the ranks that held them, and
/// those of a rank in their order there. Collective over `comm`.
void move(Workload& workload, const std::vector<int>& ranks, MPI_Comm comm) {
    const int rank = rank_of(comm);
    const rrcb::Plan plan = rrcb::plan(ranks, size_of(comm), comm);
    const std::size_t width = static_cast<std::size_t>(workload.dimension);
    const auto coordinates = rrcb::column(workload.coordinates, width);
    if (workload.weighted)
        std::tie(workload.coordinates, workload.weights) =
            rrcb::transfer(plan, rrcb::columns(coordinates, workload.weights), comm);
    else
        workload.coordinates = rrcb::transfer(plan, coordinates, comm);
    // The points that stay come first. Move them behind those that arrive from lower ranks.
    const auto kept = plan.num_points - plan.export_indices.size();
    const auto before = static_cast<std::size_t>(std::ranges::lower_bound(plan.import_ranks, rank) -
                                                 plan.import_ranks.begin());
    const auto order = [&](std::vector<double>& column, std::size_t components) {
        const auto begin = column.data();
        std::rotate(begin, begin + kept * components, begin + (kept + before) * components);
    };
    order(workload.coordinates, width);
    if (workload.weighted) order(workload.weights, 1);
}

/// Sends every point to its rank of the layout, from any distribution of the points. Collective
/// over `comm`.
///
/// The result depends only on the points and the number of ranks if each rank passes a section of
/// one global order, in the order of the ranks.
void distribute(Workload& workload, Layout layout, std::uint64_t seed, MPI_Comm comm) {
    const std::vector<int> ranks =
        layout == Layout::sorted
            ? sorted_ranks(curve_places(workload, comm), hilbert_cells(workload.dimension), comm)
            : random_ranks(workload.points().count, seed, comm);
    move(workload, ranks, comm);
    if (layout == Layout::sorted) reorder(workload, curve_places(workload, comm));
}

/// Sends the properties of rank 0's points to all ranks.
void broadcast_shape(Workload& workload, MPI_Comm comm) {
    MPI_Bcast(&workload.dimension, 1, MPI_INT, 0, comm);
    MPI_Bcast(&workload.weighted, 1, MPI_CXX_BOOL, 0, comm);
}

}  // namespace

Workload cloud_workload(const Cloud& cloud, Layout layout, MPI_Comm comm) {
    const int rank = rank_of(comm);
    const int size = size_of(comm);
    Workload workload;
    workload.name = cloud.name;
    workload.layout = layout_name(layout);
    workload.dimension = cloud.dimension;
    workload.coordinates =
        cloud_points(cloud, cloud.num_points * rank / size, cloud.num_points * (rank + 1) / size);
    distribute(workload, layout, cloud.seed, comm);
    return workload;
}

Workload file_workload(const std::string& file, Layout layout, std::uint64_t seed, MPI_Comm comm) {
    Workload workload;
    on_root([&] { workload = read_points_file(file); }, comm);
    broadcast_shape(workload, comm);
    workload.name = std::filesystem::path(file).stem().string();
    workload.layout = layout_name(layout);
    distribute(workload, layout, seed, comm);
    return workload;
}

Replay read_replay(const std::string& folder, MPI_Comm comm) {
    Dump dump;
    on_root([&] { dump = read_dump(folder); }, comm);
    Workload& workload = dump.workload;
    broadcast_shape(workload, comm);
    int num_ranks = static_cast<int>(dump.counts.size());
    MPI_Bcast(&num_ranks, 1, MPI_INT, 0, comm);
    const int size = size_of(comm);
    const bool same_ranks = num_ranks == size;
    const auto count = static_cast<GlobalCount>(workload.points().count);
    std::vector<int> ranks;
    for (int r = 0; count > 0 && r < size; ++r) {
        const GlobalCount share = same_ranks ? dump.counts[static_cast<std::size_t>(r)]
                                             : count * (r + 1) / size - count * r / size;
        ranks.insert(ranks.end(), static_cast<std::size_t>(share), r);
    }
    move(workload, ranks, comm);
    // The name is the last component of the path, with or without a trailing slash.
    const std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
    workload.name = (path.has_filename() ? path : path.parent_path()).filename().string();
    workload.layout = same_ranks ? "dump" : "dealt";
    if (!same_ranks)
        dump.note += "dump: of " + std::to_string(num_ranks) + " ranks, dealt out in order to " +
                     std::to_string(size) + '\n';
    return {std::move(workload), std::move(dump.note)};
}

}  // namespace comparisons
