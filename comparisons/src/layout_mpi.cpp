#include "layout_mpi.hpp"

#include "counter_random.hpp"
#include "hilbert.hpp"

#include <algorithm>
#include <numeric>

namespace comparisons {

namespace {

using rrcb::GlobalCount;

std::vector<std::size_t> curve_places(const Workload& workload, MPI_Comm comm) {
    const rrcb::Box box = global_box(workload, comm);
    const rrcb::Points points = workload.points();
    std::vector<std::size_t> places(points.count);
    for (std::size_t i = 0; i < points.count; ++i) {
        places[i] = hilbert_cell(box, points.position(i), workload.dimension);
    }
    return places;
}

/// Rank of each point when the curve is cut into pieces of equal count; points in one cell of the
/// curve keep their order.
std::vector<int> sorted_ranks(const std::vector<std::size_t>& places, std::size_t num_cells,
                              MPI_Comm comm) {
    int size = 0;
    MPI_Comm_size(comm, &size);
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
    int size = 0;
    MPI_Comm_size(comm, &size);
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

struct Lengths {
    std::vector<int> counts;
    std::vector<int> starts;
};

Lengths with_starts(std::vector<int> counts) {
    std::vector<int> starts(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    return {std::move(counts), std::move(starts)};
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

rrcb::Box global_box(const Workload& workload, MPI_Comm comm) {
    rrcb::Box box = rrcb::bounding_box(workload.points());
    MPI_Allreduce(MPI_IN_PLACE, box.lower.data(), 3, MPI_DOUBLE, MPI_MIN, comm);
    MPI_Allreduce(MPI_IN_PLACE, box.upper.data(), 3, MPI_DOUBLE, MPI_MAX, comm);
    return box;
}

const char* layout_name(Layout layout) {
    return layout == Layout::sorted ? "sorted" : "scattered";
}

void distribute(Workload& workload, Layout layout, std::uint64_t seed, MPI_Comm comm) {
    const std::vector<int> ranks =
        layout == Layout::sorted
            ? sorted_ranks(curve_places(workload, comm), hilbert_cells(workload.dimension), comm)
            : random_ranks(workload.points().count, seed, comm);
    workload.coordinates = exchange(workload.coordinates, workload.dimension, ranks, comm);
    if (workload.weighted) workload.weights = exchange(workload.weights, 1, ranks, comm);
    if (layout == Layout::sorted) reorder(workload, curve_places(workload, comm));
}

std::vector<double> exchange(const std::vector<double>& rows, int width,
                             const std::vector<int>& ranks, MPI_Comm comm) {
    int size = 0;
    MPI_Comm_size(comm, &size);
    std::vector<int> counts(static_cast<std::size_t>(size));
    for (const int rank : ranks) ++counts[static_cast<std::size_t>(rank)];
    const Lengths out = with_starts(counts);
    MPI_Alltoall(out.counts.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    const Lengths in = with_starts(counts);

    const auto row_length = static_cast<std::size_t>(width);
    std::vector<double> packed(rows.size());
    std::vector<int> next = out.starts;
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        const auto slot = static_cast<std::size_t>(next[static_cast<std::size_t>(ranks[i])]++);
        std::copy_n(&rows[i * row_length], row_length, &packed[slot * row_length]);
    }
    std::vector<double> received(static_cast<std::size_t>(in.starts.back() + in.counts.back()) *
                                 row_length);
    MPI_Datatype row = MPI_DATATYPE_NULL;
    MPI_Type_contiguous(width, MPI_DOUBLE, &row);
    MPI_Type_commit(&row);
    MPI_Alltoallv(packed.data(), out.counts.data(), out.starts.data(), row, received.data(),
                  in.counts.data(), in.starts.data(), row, comm);
    MPI_Type_free(&row);
    return received;
}

}  // namespace comparisons
