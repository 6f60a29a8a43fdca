#include "part_loads_mpi.hpp"

#include <rrcb/plan.hpp>
#include <rrcb/transfer.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

namespace comparisons {

void follow(std::vector<int>& owners, const std::vector<mpm::Box>& boxes, mpm::Positions at) {
    for (std::size_t i = 0; i < owners.size(); ++i) {
        const mpm::Vector x = at[i];
        if (mpm::contains(boxes[static_cast<std::size_t>(owners[i])], x)) continue;
        const auto holds = [&](const mpm::Box& box) { return mpm::contains(box, x); };
        owners[i] = static_cast<int>(std::ranges::find_if(boxes, holds) - boxes.begin());
    }
}

PointTracks::PointTracks(MPI_Comm comm) : comm_(comm) {
    MPI_Comm_rank(comm, &rank_);
    MPI_Comm_size(comm, &num_ranks_);
}

void PointTracks::add(const MovingPoints& points) {
    const mpm::Positions at = points.positions();
    const std::span<const double> ids = points.particles()["id"];
    count_points(ids.size());
    int num_axes = at.z.empty() ? 2 : 3;  // 2 as well where there are no points
    MPI_Allreduce(MPI_IN_PLACE, &num_axes, 1, MPI_INT, MPI_MAX, comm_);
    std::vector<rrcb::Part> ranks;
    for (const double id : ids) {
        const auto number = static_cast<std::int64_t>(id);
        ranks.push_back(static_cast<rrcb::Part>(number * num_ranks_ / num_points_));
    }
    const rrcb::Plan plan = rrcb::plan(ranks, num_ranks_, comm_);
    const std::vector<double> my_ids = rrcb::transfer(plan, ids, comm_);
    const std::int64_t first = (rank_ * num_points_ + num_ranks_ - 1) / num_ranks_;
    Columns columns;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(num_axes); ++axis) {
        const std::span<const double> sent = axis == 0 ? at.x : axis == 1 ? at.y : at.z;
        const std::vector<double> received = rrcb::transfer(plan, sent, comm_);
        columns[axis].resize(received.size());
        for (std::size_t i = 0; i < received.size(); ++i) {
            const auto place = static_cast<std::int64_t>(my_ids[i]) - first;
            columns[axis][static_cast<std::size_t>(place)] = received[i];
        }
    }
    snapshots_.push_back(std::move(columns));
}

void PointTracks::add(Columns columns) {
    count_points(columns[0].size());
    snapshots_.push_back(std::move(columns));
}

void PointTracks::count_points(std::size_t mine) {
    num_points_ = static_cast<std::int64_t>(mine);
    MPI_Allreduce(MPI_IN_PLACE, &num_points_, 1, MPI_INT64_T, MPI_SUM, comm_);
}

mpm::Positions PointTracks::positions(int time) const {
    const Columns& columns = snapshots_[static_cast<std::size_t>(time)];
    return {columns[0], columns[1], columns[2]};
}

void PointTracks::count(LoadTable& table, int made, const mpm::Balancer& balancer) const {
    const mpm::Positions start = positions(made);
    const mpm::Decomposition parts = balancer(start, comm_);
    std::vector<int> owners = parts.local_owners;
    if (owners.empty()) {
        owners.resize(start.size());
        parts.owners(start, owners);
    }
    const auto num_ranks = static_cast<std::size_t>(num_ranks_);
    std::vector<std::int64_t> counts;
    for (int at = made; at < num_times(); ++at) {
        follow(owners, parts.boxes, positions(at));
        counts.resize(counts.size() + num_ranks);
        for (const int owner : owners) ++counts[counts.size() - num_ranks + owner];
    }
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), static_cast<int>(counts.size()), MPI_INT64_T,
                  MPI_SUM, comm_);
    const double mean = static_cast<double>(num_points_) / num_ranks_;
    auto next = counts.begin();
    for (int at = made; at < num_times(); ++at) {
        for (int part = 0; part < num_ranks_; ++part) {
            table.load(made, at, part) = static_cast<double>(*next++) / mean;
        }
    }
}

}  // namespace comparisons
