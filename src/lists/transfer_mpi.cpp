#include "collective/attribute_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/rank_order.hpp"
#include "lists/delivery_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/transfer_log.hpp"
#include "options/rejection.hpp"

#include <algorithm>
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

void move(const Plan& plan, std::span<const detail::ByteColumn> columns,
          const TransferLimits& limits, TransferReport* report, Participant& self) {
    Delivery delivery;
    std::vector<LocalIndex> sent;
    std::vector<RankCount> to;
    std::vector<RankCount> from;
    TransferLog* log = nullptr;
    self.attempt([&] {
        const int num_ranks = mpi::size_of(self.comm);
        mpi::require_group(plan.group, "the plan", self);
        check_lists(plan, num_ranks);
        RankOrder order(plan.export_ranks, num_ranks);
        sent.resize(plan.export_indices.size());
        order.for_each(
            [&](std::size_t k, std::size_t place) { sent[place] = plan.export_indices[k]; });
        to = order.counts();
        from = count_ascending(plan.import_ranks);
        const LocalIndex num_kept = plan.num_points - plan.export_indices.size();
        delivery = {plan.num_points, num_kept, plan.export_indices, sent, to, from};
        log = mpi::Attribute<TransferLog>::find(self.comm);
        if (log == nullptr)
            log = mpi::Attribute<TransferLog>::keep(std::make_unique<TransferLog>(), self.comm);
    });
    const Delivered delivered = deliver(delivery, columns, limits, report, self);
    log->add(plan, delivered.moves, delivered.is_like_before);
}

void detail::move(const Plan& plan, std::span<const ByteColumn> columns,
                  const TransferLimits& limits, TransferReport* report, MPI_Comm user) {
    Participant self = mpi::enter(user, CallName::transfer);
    rrcb::move(plan, columns, limits, report, self);
}

}  // namespace rrcb
