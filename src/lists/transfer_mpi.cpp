#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "lists/delivery_mpi.hpp"
#include "options/rejection.hpp"

#include <rrcb/transfer.hpp>

#include <algorithm>
#include <functional>
#include <numeric>

namespace rrcb {

namespace {

void check_lists(const Plan& plan) {
    const std::vector<LocalIndex>& exports = plan.export_indices;
    require(exports.size() == plan.export_ranks.size(),
            "the lists of exports of the plan differ in length");
    require(std::ranges::adjacent_find(exports, std::greater_equal<>()) == exports.end() &&
                (exports.empty() || exports.back() < plan.num_points),
            "export_indices of the plan must ascend below num_points");
    require(std::ranges::is_sorted(plan.import_ranks), "import_ranks of the plan must ascend");
}

/// Number of times that each rank is named, by ascending rank; `ranks` may be in any order.
std::vector<RankCount> counts_of(std::span<const int> ranks, int num_ranks) {
    std::vector<LocalIndex> per_rank(static_cast<std::size_t>(num_ranks), 0);
    for (const int rank : ranks) {
        require(rank >= 0 && rank < num_ranks,
                "the plan names a rank that is none of this communicator");
        ++per_rank[static_cast<std::size_t>(rank)];
    }
    std::vector<RankCount> counts;
    for (int rank = 0; rank < num_ranks; ++rank) {
        const LocalIndex count = per_rank[static_cast<std::size_t>(rank)];
        if (count > 0) counts.push_back({rank, count});
    }
    return counts;
}

/// Indices of the exports for one rank after the other, ascending for each.
std::vector<LocalIndex> sort_by_rank(const Plan& plan, std::span<const RankCount> counts,
                                     int num_ranks) {
    std::vector<LocalIndex> next(static_cast<std::size_t>(num_ranks), 0);
    LocalIndex begin = 0;
    for (const RankCount& share : counts) {
        next[static_cast<std::size_t>(share.rank)] = begin;
        begin += share.count;
    }
    std::vector<LocalIndex> sorted(plan.export_indices.size());
    for (std::size_t k = 0; k < sorted.size(); ++k)
        sorted[next[static_cast<std::size_t>(plan.export_ranks[k])]++] = plan.export_indices[k];
    return sorted;
}

}  // namespace

void detail::move(const Plan& plan, std::span<const ByteColumn> columns,
                  const TransferLimits& limits, TransferReport* report, MPI_Comm user) {
    mpi::Duplicate& kept = mpi::duplicate_with(user);
    Participant self{kept.comm};
    Delivery delivery;
    std::vector<LocalIndex> sent;
    self.attempt([&] {
        const int num_ranks = mpi::size_of(self.comm);
        check_lists(plan);
        delivery.num_points = plan.num_points;
        delivery.num_kept = plan.num_points - plan.export_indices.size();
        delivery.removed = plan.export_indices;
        delivery.to = counts_of(plan.export_ranks, num_ranks);
        delivery.from = counts_of(plan.import_ranks, num_ranks);
        sent = sort_by_rank(plan, delivery.to, num_ranks);
        delivery.sent = sent;
    });
    deliver(delivery, columns, limits, report, mpi::per_rank_of(kept), self);
}

}  // namespace rrcb
