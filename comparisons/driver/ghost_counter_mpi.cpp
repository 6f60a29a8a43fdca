#include "ghost_counter_mpi.hpp"

#include "failure_mpi.hpp"

#include <rrcb/transfer.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace comparisons {

namespace {

/// Positions of this rank's finite points and their indices.
struct FinitePoints {
    explicit FinitePoints(const rrcb::Points& points) {
        for (std::size_t i = 0; i < points.count; ++i) {
            const rrcb::Vector x = points.position(i);
            if (!std::ranges::all_of(x, [](double at) { return std::isfinite(at); })) continue;
            indices.push_back(i);
            positions.push_back(x);
        }
    }

    std::vector<std::size_t> indices;
    std::vector<rrcb::Vector> positions;
};

rrcb::Box box_of_all(const std::vector<rrcb::Vector>& positions, MPI_Comm comm) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    rrcb::Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const rrcb::Vector& x : positions) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.lower[axis] = std::min(box.lower[axis], x[axis]);
            box.upper[axis] = std::max(box.upper[axis], x[axis]);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, box.lower.data(), 3, MPI_DOUBLE, MPI_MIN, comm);
    MPI_Allreduce(MPI_IN_PLACE, box.upper.data(), 3, MPI_DOUBLE, MPI_MAX, comm);
    return box;
}

/// Side of a cube of which as many as there are points fill the box, on the axes on which points
/// differ; 1 if all coincide, so that any distance does.
double mean_spacing(const rrcb::Box& box, std::size_t mine, MPI_Comm comm) {
    auto count = static_cast<std::int64_t>(mine);
    MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_INT64_T, MPI_SUM, comm);
    double sum_of_logs = -std::log(static_cast<double>(count));
    int num_axes = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(box.upper[axis] > box.lower[axis])) continue;
        sum_of_logs += std::log(box.upper[axis] - box.lower[axis]);
        ++num_axes;
    }
    return num_axes > 0 ? std::exp(sum_of_logs / num_axes) : 1;
}

/// Layers of the grid on axis 0, dealt over the ranks.
struct Slabs {
    std::int64_t num_layers;
    int num_ranks;

    int rank_of(std::int64_t layer) const {
        return static_cast<int>(std::clamp<std::int64_t>(layer, 0, num_layers - 1) * num_ranks /
                                num_layers);
    }

    std::int64_t first_layer(int rank) const {
        return (rank * num_layers + num_ranks - 1) / num_ranks;
    }
};

}  // namespace

GhostCounter::GhostCounter(const Workload& workload, const GhostRule& rule, MPI_Comm comm)
    : comm_(comm), rule_(rule) {
    FinitePoints mine(workload.points());
    rrcb::Box box = box_of_all(mine.positions, comm);
    radius_ = rule.radius.value_or(2 * mean_spacing(box, mine.positions.size(), comm));
    // The slabs lie along the longest side.
    const auto extent = [&](std::size_t axis) { return box.upper[axis] - box.lower[axis]; };
    const std::size_t longest = extent(1) > extent(0) ? 1 : 0;
    const std::size_t first = extent(2) > extent(longest) ? 2 : longest;
    std::swap(box.lower[0], box.lower[first]);
    std::swap(box.upper[0], box.upper[first]);
    for (rrcb::Vector& x : mine.positions) std::swap(x[0], x[first]);

    const CutOffGrid grid(box, radius_);
    const Slabs slabs{grid.index(box.upper[0], 0) + 1, size_of(comm)};
    std::vector<rrcb::Part> ranks;
    std::vector<rrcb::Vector> sent;
    for (std::size_t i = 0; i < mine.positions.size(); ++i) {
        const std::int64_t layer = grid.index(mine.positions[i][0], 0);
        for (int step = -1, last = -1; step <= 1; ++step) {
            const int rank = slabs.rank_of(layer + step);
            if (rank == last) continue;
            last = rank;
            sources_.push_back(mine.indices[i]);
            sent.push_back(mine.positions[i]);
            ranks.push_back(rank);
        }
    }
    plan_ = rrcb::plan(ranks, slabs.num_ranks, comm);
    const int rank = comparisons::rank_of(comm);
    cells_.emplace(rrcb::transfer(plan_, sent, comm), box, radius_, slabs.first_layer(rank),
                   slabs.first_layer(rank + 1));
}

Ghosts GhostCounter::count(const std::vector<rrcb::Part>& parts, int num_parts) const {
    std::vector<rrcb::Part> sent;
    for (const std::size_t i : sources_) sent.push_back(parts[i]);
    GhostSums sums(num_parts);
    cells_->count(rrcb::transfer(plan_, sent, comm_), rule_.ranks_per_node, sums);
    MPI_Allreduce(MPI_IN_PLACE, sums.needed.data(), num_parts, MPI_INT64_T, MPI_SUM, comm_);
    MPI_Allreduce(MPI_IN_PLACE, &sums.off_machine, 1, MPI_INT64_T, MPI_SUM, comm_);
    // A row at a time, because its square may be more than an int counts.
    Ghosts result{radius_, std::accumulate(sums.needed.begin(), sums.needed.end(), std::int64_t{0}),
                  std::ranges::max(sums.needed)};
    for (auto row = sums.are_touching.begin(); row != sums.are_touching.end(); row += num_parts) {
        MPI_Allreduce(MPI_IN_PLACE, &*row, num_parts, MPI_UNSIGNED_CHAR, MPI_MAX, comm_);
        const auto neighbours = static_cast<int>(std::count(row, row + num_parts, 1));
        result.most_neighbours = std::max(result.most_neighbours, neighbours);
    }
    if (rule_.ranks_per_node) result.off_machine = sums.off_machine;
    return result;
}

}  // namespace comparisons
