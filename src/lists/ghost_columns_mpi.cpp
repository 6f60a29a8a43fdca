#include "collective/attribute_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/stamp_access.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/kept_delivery_mpi.hpp"
#include "lists/transfer_log.hpp"
#include "options/rejection.hpp"

#include <algorithm>

namespace rrcb {

namespace {

using detail::ByteColumn;

/// Throws Error unless the plan is consistent; returns the number of ghosts.
LocalIndex check(const GhostPlan& plan, const Participant& self) {
    mpi::require_group(detail::StampAccess::ranks(plan.stamp), "the plan", self);
    const int num_ranks = mpi::size_of(self.comm);
    check_counts(plan.send, plan.send_indices.size(), num_ranks);
    const LocalIndex num_ghosts = total(plan.receive);
    check_counts(plan.receive, num_ghosts, num_ranks);
    require(
        std::ranges::all_of(plan.send_indices, [&](LocalIndex i) { return i < plan.num_points; }),
        "send_indices of the plan must be below num_points; give the plan as it was made");
    return num_ghosts;
}

/// If the points of the ghosts may have moved since, returns the number of the transfer; otherwise
/// 0.
std::uint64_t overtaking(const GhostPlan& plan, MPI_Comm comm) {
    const TransferLog* log = mpi::Attribute<TransferLog>::find(comm);
    return log != nullptr && detail::StampAccess::points(plan.stamp) != 0 ? log->overtaking(plan)
                                                                          : 0;
}

/// Throws Error unless the groups are consistent. Returns the number of groups that other ranks
/// own.
LocalIndex check(const Groups& groups, const Participant& self) {
    const LocalIndex num_elsewhere = check(groups.plan, self);
    const LocalIndex num_groups = groups.plan.num_points + num_elsewhere;
    require(std::ranges::all_of(groups.of_points, [&](LocalIndex g) { return g < num_groups; }),
            "of_points of the groups must be below the number of groups; give the groups as they "
            "were made");
    return num_elsewhere;
}

/// Gives each point the value of its group.
void spread(const Groups& groups, const ByteResult& values, std::size_t point_bytes,
            std::byte* to) {
    for (const LocalIndex group : groups.of_points) {
        std::copy_n(&values.bytes[group * point_bytes], point_bytes, to);
        to += point_bytes;
    }
}

/// Copies a column, unless its result is the same array.
void copy(const ByteColumn& column) {
    std::byte* result = column.resize(column.result, column.num_values);
    if (result == column.from) return;
    std::copy_n(column.from, column.num_values * column.value_bytes, result);
}

Delivery delivery_of(const GhostPlan& plan) {
    return {.num_points = plan.num_points,
            .sent = plan.send_indices,
            .to = plan.send,
            .from = plan.receive};
}

/// Throws Error unless the columns of the ghosts have the lengths of the plan, and as many
/// components as the columns of the points. Copies the latter to their results.
void check_sums(const GhostPlan& plan, LocalIndex num_ghosts, std::span<const ByteColumn> of_ghosts,
                std::span<const ByteColumn> of_points) {
    for (const ByteColumn& column : of_ghosts)
        check_column(column, num_ghosts, "ghosts of the plan");
    for (std::size_t k = 0; k < of_points.size(); ++k) {
        require(of_ghosts[k].components == of_points[k].components,
                "columns of ghosts must have as many components as those of the points");
        check_column(of_points[k], plan.num_points, "points of the plan");
        copy(of_points[k]);
    }
}

/// Sends columns of ghosts back. Needs no collective calls if the ranks have sent the same columns
/// before.
void send_back(const GhostPlan& plan, std::span<const ByteColumn> of_ghosts,
               std::span<const ByteColumn> of_points, const TransferOptions& options, CallName call,
               CallName kept_call, MPI_Comm user) {
    using detail::KeptExchange;
    if (NeighbourExchange* exchange = KeptExchange::find(plan, call, of_ghosts, options, user)) {
        exchange->begin(kept_call);
        const Delivery delivery{
            .num_points = total(plan.receive), .to = plan.receive, .from = plan.send};
        exchange->attempt([&] { check_sums(plan, delivery.num_points, of_ghosts, of_points); });
        return deliver_kept(delivery, of_ghosts, options.report, *exchange);
    }
    Participant self = mpi::enter(user, call);
    KeptExchange::keep(plan, self);
    if (rrcb::move_back(plan, of_ghosts, of_points, options, self))
        plan.kept->note(call, of_ghosts, options);
}

}  // namespace

bool move(const GhostPlan& plan, std::span<const ByteColumn> columns,
          const TransferOptions& options, Participant& self) {
    Delivery delivery = delivery_of(plan);
    self.attempt([&] {
        check(plan, self);
        delivery.overtaking = overtaking(plan, self.comm);
    });
    return deliver(delivery, columns, options, self).fits;
}

bool move_back(const GhostPlan& plan, std::span<const ByteColumn> of_ghosts,
               std::span<const ByteColumn> of_points, const TransferOptions& options,
               Participant& self) {
    Delivery delivery{.to = plan.receive, .from = plan.send};
    self.attempt([&] {
        delivery.num_points = check(plan, self);
        delivery.overtaking = overtaking(plan, self.comm);
        check_sums(plan, delivery.num_points, of_ghosts, of_points);
    });
    return deliver(delivery, of_ghosts, options, self).fits;
}

void move(const detail::Replies& replies, std::span<const ByteColumn> columns,
          const TransferOptions& options, Participant& self) {
    move_back(replies.plan, columns, {}, options, self);
}

void move(const Groups& groups, std::span<const ByteColumn> columns, const TransferOptions& options,
          Participant& self) {
    const LocalIndex num_groups = groups.plan.num_points;
    const Delivery delivery{.num_points = num_groups,
                            .num_kept = num_groups,
                            .sent = groups.plan.send_indices,
                            .to = groups.plan.send,
                            .from = groups.plan.receive};
    std::vector<ByteResult> values;
    std::vector<ByteColumn> of_groups;
    std::vector<std::byte*> results;
    self.attempt([&] {
        check(groups, self);
        values.reserve(columns.size());
        for (const ByteColumn& column : columns) {
            check_column(column, num_groups, "groups of this rank");
            results.push_back(
                column.resize(column.result, groups.of_points.size() * column.components));
            of_groups.push_back(
                values.emplace_back(ByteResult{column.value_bytes}).result_of(column));
        }
    });
    deliver(delivery, of_groups, options, self);
    for (std::size_t k = 0; k < columns.size(); ++k)
        spread(groups, values[k], columns[k].components * columns[k].value_bytes, results[k]);
}

std::vector<double> group_sums(const Groups& groups, std::span<const double> values,
                               std::size_t components, Participant& self) {
    std::vector<double> all;
    std::vector<double> elsewhere;
    std::vector<double> arrived;
    self.attempt([&] {
        const LocalIndex num_elsewhere = check(groups, self);
        check_column(detail::byte_column(Column<double>{values, components}, all),
                     groups.of_points.size(), "points of the groups");
        all.resize((groups.plan.num_points + num_elsewhere) * components);
        detail::add_each(groups.of_points, components, values.data(), all.data());
        elsewhere.assign(all.end() - static_cast<std::ptrdiff_t>(num_elsewhere * components),
                         all.end());
        all.resize(groups.plan.num_points * components);
    });
    const std::array sent{detail::byte_column(Column<double>{elsewhere, components}, arrived)};
    move_back(groups.plan, sent, {}, {}, self);
    detail::add_each(groups.plan.send_indices, components, arrived.data(), all.data());
    return all;
}

void detail::move(const GhostPlan& plan, std::span<const ByteColumn> columns,
                  const TransferOptions& options, MPI_Comm user) {
    if (NeighbourExchange* exchange =
            KeptExchange::find(plan, CallName::fetch, columns, options, user)) {
        exchange->begin(CallName::kept_fetch);
        return deliver_kept(delivery_of(plan), columns, options.report, *exchange);
    }
    Participant self = mpi::enter(user, CallName::fetch);
    KeptExchange::keep(plan, self);
    if (rrcb::move(plan, columns, options, self))
        plan.kept->note(CallName::fetch, columns, options);
}

void detail::move_back(const GhostPlan& plan, std::span<const ByteColumn> of_ghosts,
                       std::span<const ByteColumn> of_points, const TransferOptions& options,
                       MPI_Comm user) {
    send_back(plan, of_ghosts, of_points, options, CallName::accumulate, CallName::kept_accumulate,
              user);
}

void detail::move(const Replies& replies, std::span<const ByteColumn> columns,
                  const TransferOptions& options, MPI_Comm user) {
    send_back(replies.plan, columns, {}, options, CallName::reply, CallName::kept_reply, user);
}

void detail::move(const Groups& groups, std::span<const ByteColumn> columns,
                  const TransferOptions& options, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::fetch_from_groups);
    rrcb::move(groups, columns, options, self);
}

std::vector<double> group_sums(const Groups& groups, std::span<const double> values, MPI_Comm user,
                               std::size_t components) {
    Participant self = mpi::enter(user, CallName::sums);
    return group_sums(groups, values, components, self);
}

}  // namespace rrcb
