#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/ghosts_mpi.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <numeric>

namespace rrcb {

namespace {

using detail::ByteColumn;

/// Throws Error unless the plan holds together; returns the number of ghosts.
LocalIndex check(const GhostPlan& plan, int num_ranks) {
    check_counts(plan.send, plan.send_indices.size(), num_ranks);
    LocalIndex num_ghosts = 0;
    for (const RankCount& share : plan.receive) num_ghosts += share.count;
    check_counts(plan.receive, num_ghosts, num_ranks);
    require(
        std::ranges::all_of(plan.send_indices, [&](LocalIndex i) { return i < plan.num_points; }),
        "send_indices of the plan must be below num_points");
    return num_ghosts;
}

/// Copies a column, unless its result stands in its place.
void copy(const ByteColumn& column) {
    std::byte* result = column.resize(column.result, column.num_values);
    if (result == column.from) return;
    std::copy_n(column.from, column.num_values * column.value_bytes, result);
}

}  // namespace

void move(const GhostPlan& plan, std::span<const ByteColumn> columns, const TransferLimits& limits,
          TransferReport* report, Participant& self) {
    Delivery delivery{.num_points = plan.num_points, .sent = plan.send_indices};
    self.attempt([&] {
        check(plan, mpi::size_of(self.comm));
        delivery.to = plan.send;
        delivery.from = plan.receive;
    });
    deliver(delivery, columns, limits, report, self);
}

void move_back(const GhostPlan& plan, std::span<const ByteColumn> of_ghosts,
               std::span<const ByteColumn> of_points, const TransferLimits& limits,
               TransferReport* report, Participant& self) {
    Delivery delivery;
    std::vector<LocalIndex> all;
    self.attempt([&] {
        delivery.num_points = check(plan, mpi::size_of(self.comm));
        for (std::size_t k = 0; k < of_points.size(); ++k) {
            require(of_ghosts[k].components == of_points[k].components,
                    "columns of ghosts must have as many components as those of the points");
            check_column(of_ghosts[k], delivery.num_points, "ghosts of the plan");
            check_column(of_points[k], plan.num_points, "points of the plan");
            copy(of_points[k]);
        }
        all.resize(delivery.num_points);
        std::iota(all.begin(), all.end(), LocalIndex{0});
        delivery.sent = all;
        delivery.to = plan.receive;
        delivery.from = plan.send;
    });
    deliver(delivery, of_ghosts, limits, report, self);
}

void detail::move(const GhostPlan& plan, std::span<const ByteColumn> columns,
                  const TransferLimits& limits, TransferReport* report, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    rrcb::move(plan, columns, limits, report, self);
}

void detail::move_back(const GhostPlan& plan, std::span<const ByteColumn> of_ghosts,
                       std::span<const ByteColumn> of_points, const TransferLimits& limits,
                       TransferReport* report, MPI_Comm user) {
    Participant self{mpi::duplicate_of(user)};
    rrcb::move_back(plan, of_ghosts, of_points, limits, report, self);
}

}  // namespace rrcb
