#include "lists/kept_delivery_mpi.hpp"

#include "collective/attribute_mpi.hpp"
#include "collective/column_type.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/message_rows.hpp"
#include "lists/transfer_log.hpp"
#include "options/rejection.hpp"

#include <rrcb/detail/mix.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace rrcb {

using detail::ByteColumn;

namespace {

/// Returns the ranks that occur in either list of the plan, without this rank, ascending.
std::vector<int> other_ranks(const GhostPlan& plan, int rank) {
    std::vector<int> ranks;
    for (const std::vector<RankCount>* counts : {&plan.send, &plan.receive})
        for (const RankCount& one : *counts)
            if (one.rank != rank) ranks.push_back(one.rank);
    std::ranges::sort(ranks);
    ranks.erase(std::ranges::unique(ranks).begin(), ranks.end());
    return ranks;
}

/// The rows of one rank in a list that is sorted by rank.
struct RowRange {
    LocalIndex first = 0;
    LocalIndex count = 0;
};

RowRange rows_of(std::span<const RankCount> counts, int rank) {
    RowRange rows;
    for (const RankCount& one : counts) {
        if (one.rank == rank) return {rows.first, one.count};
        rows.first += one.count;
    }
    return rows;
}

std::uint64_t hash_of(CallName call, std::span<const ByteColumn> columns,
                      const TransferOptions& options) {
    std::uint64_t hash = detail::mix(options.max_bytes ^ static_cast<std::uint64_t>(call) << 56);
    for (const ByteColumn& column : columns) hash = detail::mix(hash ^ type_of(column));
    return hash;
}

std::uint64_t hash_of(const GhostPlan& plan) {
    std::uint64_t hash = plan.num_points;
    for (const std::vector<RankCount>* counts : {&plan.send, &plan.receive})
        for (const RankCount& one : *counts)
            hash =
                detail::mix(hash ^ detail::mix(one.count) ^ static_cast<std::uint64_t>(one.rank));
    return hash;
}

void write(const ByteColumn& column, std::span<const LocalIndex> points, const RowRange& rows,
           std::byte* place) {
    const std::size_t bytes = row_bytes(column);
    if (points.empty())
        return copy_bytes(column.from + rows.first * bytes, rows.count * bytes, place);
    gather(column.from, bytes, points.subspan(rows.first, rows.count), place);
}

}  // namespace

detail::KeptExchange::KeptExchange(const GhostPlan& plan, const Participant& self)
    : exchange_(other_ranks(plan, mpi::rank_of(self.comm)), self.log), lists_(hash_of(plan)) {}

void detail::KeptExchange::keep(const GhostPlan& plan, Participant& self) {
    self.attempt([&] {
        if (plan.kept == nullptr || &plan.kept->exchange_.log() != self.log.get() ||
            plan.kept->lists_ != hash_of(plan))
            plan.kept = std::make_shared<KeptExchange>(plan, self);
    });
}

std::uint64_t detail::KeptExchange::num_transfers() const {
    const TransferLog* log = mpi::Attribute<TransferLog>::find(exchange_.log().comm);
    return log != nullptr ? log->number() : 0;
}

NeighbourExchange* detail::KeptExchange::find(const GhostPlan& plan, CallName call,
                                              std::span<const ByteColumn> columns,
                                              const TransferOptions& options, MPI_Comm user) {
    KeptExchange* const kept = plan.kept.get();
    if (kept == nullptr || user == MPI_COMM_NULL || !mpi::is_running()) return nullptr;
    const MPI_Comm* comm = mpi::find_duplicate(user);
    if (comm == nullptr || *comm != kept->exchange_.log().comm ||
        kept->num_transfers() != kept->num_transfers_ || kept->lists_ != hash_of(plan))
        return nullptr;
    const auto known =
        std::span(kept->proven_).first(std::min(kept->num_proven_, kept->proven_.size()));
    return std::ranges::count(known, hash_of(call, columns, options)) > 0 ? &kept->exchange_
                                                                          : nullptr;
}

void detail::KeptExchange::note(CallName call, std::span<const ByteColumn> columns,
                                const TransferOptions& options) {
    if (num_transfers() != std::exchange(num_transfers_, num_transfers())) num_proven_ = 0;
    proven_[num_proven_++ % proven_.size()] = hash_of(call, columns, options);
}

void deliver_kept(const Delivery& delivery, std::span<const ByteColumn> columns,
                  TransferReport* report, NeighbourExchange& exchange) {
    const std::span<const int> ranks = exchange.ranks();
    std::size_t bytes_sent = 0;
    exchange.attempt([&] {
        exchange.set_types(columns);
        require(std::ranges::all_of(delivery.sent,
                                    [&](LocalIndex i) { return i < delivery.num_points; }),
                "send_indices of the plan must be below num_points; give the plan as it was made");
        for (const ByteColumn& column : columns)
            check_column(column, delivery.num_points, "points of the plan");
        for (std::size_t n = 0; n < ranks.size(); ++n) {
            const RowRange rows = rows_of(delivery.to, ranks[n]);
            std::byte* place =
                exchange.message_to(n, rows.count, message_bytes(columns, rows.count));
            for (const ByteColumn& column : columns) {
                write(column, delivery.sent, rows, place);
                place += block_bytes(row_bytes(column), rows.count);
                bytes_sent += row_bytes(column) * rows.count;
            }
        }
    });
    exchange.run();
    exchange.end();
    const int rank = mpi::rank_of(exchange.log().comm);
    exchange.attempt([&] {
        for (std::size_t n = 0; n < ranks.size(); ++n)
            if (exchange.rows_from(n) != rows_of(delivery.from, ranks[n]).count)
                reject("rank " + std::to_string(ranks[n]) + " sends " +
                       std::to_string(exchange.rows_from(n)) +
                       " points, not as many as this plan has; use the plans of one call of "
                       "ghosts() on all ranks");
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const std::size_t bytes = row_bytes(columns[k]);
            std::byte* const result =
                columns[k].resize(columns[k].result, total(delivery.from) * columns[k].components);
            for (std::size_t n = 0; n < ranks.size(); ++n) {
                const RowRange rows = rows_of(delivery.from, ranks[n]);
                copy_bytes(exchange.message_from(n, message_bytes(columns, rows.count)) +
                               message_bytes(columns.first(k), rows.count),
                           rows.count * bytes, result + rows.first * bytes);
            }
            write(columns[k], delivery.sent, rows_of(delivery.to, rank),
                  result + rows_of(delivery.from, rank).first * bytes);
        }
    });
    if (report != nullptr) *report = {exchange.num_bytes(), bytes_sent, ranks.size()};
}

}  // namespace rrcb
