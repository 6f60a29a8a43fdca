#include "collective/attribute_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/rank_order.hpp"
#include "collective/stamp_access.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/transfer_log.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>

namespace rrcb {

namespace {

void check_lists(const Plan& plan, int num_ranks) {
    const std::vector<LocalIndex>& exports = plan.export_indices;
    require(exports.size() == plan.export_ranks.size(),
            "the lists of exports of the plan differ in length; give the plan as it was made");
    require(
        std::ranges::adjacent_find(exports, std::greater_equal<>()) == exports.end() &&
            (exports.empty() || exports.back() < plan.num_points),
        "export_indices of the plan must ascend below num_points; give the plan as it was made");
    require(std::ranges::is_sorted(plan.import_ranks),
            "import_ranks of the plan must ascend; give the plan as it was made");
    const auto is_here = [&](int rank) { return rank >= 0 && rank < num_ranks; };
    require(std::ranges::all_of(plan.export_ranks, is_here) &&
                (plan.import_ranks.empty() ||
                 (is_here(plan.import_ranks.front()) && is_here(plan.import_ranks.back()))),
            "the plan names a rank that is none of this communicator; give that of the plan");
}

}  // namespace

namespace {

/// Lists that a Delivery borrows during a transfer.
struct TransferLists {
    std::vector<LocalIndex> sent;
    std::vector<RankCount> to;
    std::vector<RankCount> from;
    TransferLog* log = nullptr;
};

/// Makes the lists of a transfer. Throws Error if the plan is inconsistent.
Delivery make_lists(const Plan& plan, TransferLists& lists, Participant& self) {
    const int num_ranks = mpi::size_of(self.comm);
    mpi::require_group(detail::StampAccess::ranks(plan.stamp), "the plan", self);
    check_lists(plan, num_ranks);
    RankOrder order(plan.export_ranks, num_ranks);
    lists.sent.resize(plan.export_indices.size());
    order.for_each(
        [&](std::size_t k, std::size_t place) { lists.sent[place] = plan.export_indices[k]; });
    lists.to = order.counts();
    lists.from = count_ascending(plan.import_ranks);
    lists.log = mpi::Attribute<TransferLog>::find(self.comm);
    if (lists.log == nullptr)
        lists.log = mpi::Attribute<TransferLog>::keep(std::make_unique<TransferLog>(), self.comm);
    const LocalIndex num_kept = plan.num_points - plan.export_indices.size();
    return {plan.num_points, num_kept, plan.export_indices, lists.sent, lists.to, lists.from};
}

/// Removes rows: the last rows, in ascending order, move to the places of removed ones.
void remove_rows(std::byte* rows, std::size_t row_bytes, LocalIndex num_left,
                 std::span<const LocalIndex> removed) {
    auto last = std::ranges::lower_bound(removed, num_left);
    const auto places = std::span(removed.begin(), last);
    LocalIndex from = num_left;
    for (const LocalIndex place : places) {
        for (; last != removed.end() && *last == from; ++last) ++from;
        std::memcpy(rows + place * row_bytes, rows + from * row_bytes, row_bytes);
        ++from;
    }
}

}  // namespace

void move(const Plan& plan, std::span<const detail::ByteColumn> columns,
          const TransferOptions& options, Participant& self) {
    Delivery delivery;
    TransferLists lists;
    self.attempt([&] { delivery = make_lists(plan, lists, self); });
    const Delivered delivered = deliver(delivery, columns, options, self);
    lists.log->add(plan, delivered.moves, delivered.is_like_before);
}

void move_in_place(const Plan& plan, std::span<const detail::ByteColumn> columns,
                   Participant& self) {
    Delivery delivery;
    TransferLists lists;
    self.attempt([&] {
        delivery = make_lists(plan, lists, self);
        delivery.is_in_place = true;
        delivery.num_kept = plan.num_points;
        delivery.removed = {};
        check_results(columns);
    });
    Delivered delivered;
    try {
        delivered = deliver(delivery, columns, {}, self);
    } catch (...) {
        for (const detail::ByteColumn& column : columns)
            column.resize(column.result, column.num_values);
        throw;
    }
    const LocalIndex num_all = plan.num_points + plan.import_ranks.size();
    const LocalIndex num_left = num_all - plan.export_indices.size();
    for (const detail::ByteColumn& column : columns) {
        std::byte* rows = column.resize(column.result, num_all * column.components);
        remove_rows(rows, column.components * column.value_bytes, num_left, plan.export_indices);
        column.resize(column.result, num_left * column.components);
    }
    // The columns no longer contain the points before, so they cannot be compared.
    lists.log->add(plan, delivered.moves, true);
}

void detail::move(const Plan& plan, std::span<const ByteColumn> columns,
                  const TransferOptions& options, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::transfer);
    rrcb::move(plan, columns, options, self);
}

void detail::move_in_place(const Plan& plan, std::span<const ByteColumn> columns, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::transfer);
    rrcb::move_in_place(plan, columns, self);
}

}  // namespace rrcb
