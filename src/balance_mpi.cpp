#include "balance_mpi.hpp"

#include "call_mpi.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/stage_scope.hpp"
#include "estimate/keeping_mpi.hpp"
#include "options/call_kind.hpp"
#include "options/request.hpp"
#include "passes/checked_passes.hpp"
#include "verbose_mpi.hpp"

#include <algorithm>
#include <utility>

// A call has five steps:
//   prepare    checks options and points, and allocates memory for all messages
//   estimate   rank 0 bisects the cells of all ranks, or weighs the parts of earlier cuts, or only
//              adds up the points if many ranks make the parts
//   turn?      if the ranks hold a bisection, do cuts across other axes leave far fewer ghosts?
//   keep?      are the parts that the ranks hold, or those of the earlier cuts, even enough?
//   settle     if not, the cuts move by counts of all ranks
//   report     imbalance, and the weight of each part
// Only prepare may fail on one rank; all ranks receive that failure with the estimate.

namespace rrcb {

namespace {

/// Prepares a call from scratch. Not collective.
void prepare(const Options& given, bool may_keep, Call& call, const Participant& self) {
    const StageScope stage(given.observer, Stage::moments, self.arithmetic);
    PointPasses& points = call.points;
    points.use_weights(true);
    const PointSummary summary = points.summary(true);
    introduce(given, summary, nullptr, call, self);
    const Options& options = call.options;
    const bool reads_kept = !call.is_spread && reads_kept_tree(options, mpi::size_of(self.comm));
    call.box = summary.box;
    prepare_to_settle(call, reads_kept, self);
    if (call.is_spread) call.decision.verdict.answer = Answer::weights;
    if (call.is_spread) return;
    if (reads_kept && may_keep) append_extent(summary, points.dimension(), call.mine.extents);
    make_buffers(call.decision, options, points.dimension(), reads_kept);
    add_records(points, summary.box, mpi::size_of(self.comm), options, call.mine);
}

/// Makes the ranks' present parts the result. Collective.
void keep(Call& call, Participant& self) {
    Decision& decision = call.decision;
    const bool is_known = decision.verdict.answer == Answer::kept;
    decision.cuts = std::move(call.result.cuts);
    const StageScope stage(call.options.observer, is_known ? Stage::assignment : Stage::broadcast,
                           self.arithmetic);
    if (is_known) {
        agree(self);
    } else {
        broadcast_kept(decision, self);
    }
    call.result.cuts = std::move(decision.cuts);
    const Cuts& cuts = call.result.cuts;
    Report& report = call.result.report;
    report.kept = is_in_order(cuts, decision.parts);
    report_measured(decision.verdict.kept_imbalance, call.options.imbalance_tolerance, report);
    report.part_weights = std::move(decision.part_weights);
    // A search has counted those that would divide points kept together.
    if (is_known || call.options.coincident == Coincident::divide)
        report.details.coincident_cuts = static_cast<int>(
            std::ranges::count_if(cuts.tree, [](const Cut& cut) { return cut.divides != 0; }));
    const Part part = decision.parts[mpi::rank_of(self.comm)];
    self.attempt([&] { call.points.renumber(std::span(&part, 1)); });
}

/// Turns the cuts across other axes than those between the ranks, if that leaves far fewer points
/// near them; then the ranks' present parts are not kept. Collective: a reduction.
void turn_if_better(Call& call, Participant& self) {
    Decision& decision = call.decision;
    Verdict& verdict = decision.verdict;
    const double reach = wide_reach(verdict.box, verdict.num_points);
    Bisection& turned = decision.turned;
    if (!has_far_fewer_near(turned.cuts, call.result.cuts, reach, call.points, self)) return;
    call.result.cuts = std::move(turned.cuts);
    decision.brackets = std::move(turned.brackets);
    verdict.near = verdict.turned_near;
    verdict.kept_imbalance = not_kept;
    call.result.report.details.estimated_imbalance = verdict.turned_imbalance;
}

/// Returns true if the new parts are not worth moving points out of the ranks' present parts.
bool keeps_after_all(const Call& call) {
    const Verdict& verdict = call.decision.verdict;
    const Report& report = call.result.report;
    if (call.options.refine == Refine::exact)
        return are_as_exact(call.decision.part_weights, report.part_weights, call.result.cuts,
                            verdict.balanced_heaviest(), call.options);
    return !is_worth_moving(verdict.kept_imbalance, report.imbalance, call.options);
}

}  // namespace

Balance balance_from_scratch(PointPasses& points, const Options& given, bool may_keep,
                             Participant& self) {
    Call call(points, given.observer, self);
    self.attempt([&] { prepare(given, may_keep, call, self); });
    estimate(call, self);
    if (call.decision.verdict.may_turn != 0) turn_if_better(call, self);
    const Options& options = call.options;
    const double kept = call.decision.verdict.kept_imbalance;
    bool is_kept = keeps_at_once(kept, options);
    if (!is_kept) {
        settle(call, kept < not_kept, self);
        is_kept = kept < not_kept && keeps_after_all(call);
    }
    if (is_kept) keep(call, self);
    if (call.is_spread) hold_cuts(call, self);
    self.attempt([&] { complete(call); });
    return std::move(call.result);
}

Balance balance(PointPasses& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self) {
    // One part for each rank, where the cuts are those of another number of ranks.
    const bool are_of_others =
        previous && options.num_parts == 0 && previous->num_parts != mpi::size_of(self.comm);
    Balance result = previous && !are_of_others
                         ? balance_from_earlier(points, options, *previous, may_keep, self)
                         : balance_from_scratch(points, options, may_keep, self);
    result.cuts.group = mpi::size_of(self.comm) > 1 ? self.group() : 0;
    return result;
}

Balance balance(const Points& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self, std::vector<Part> memory) {
    HostPasses host(points, std::move(memory));
    Balance result = balance(host, options, previous, may_keep, self);
    result.parts = host.take_parts();
    result.cuts.points = hash_if_leaving(points, result.parts, result.cuts.num_parts,
                                         mpi::rank_of(self.comm), mpi::size_of(self.comm));
    return result;
}

namespace {

Balance balance_over(MPI_Comm comm, const Points& points, const Options& options,
                     const Cuts& previous, std::vector<Part> memory = {}) {
    Participant self = mpi::enter(comm, CallName::balance);
    const double start = MPI_Wtime();
    Balance result = balance(points, options, given(previous), true, self, std::move(memory));
    print_line(result, options, start, self);
    self.throw_failed_message();
    return result;
}

}  // namespace

Balance balance(const Points& points, const Options& options, const Cuts& previous, MPI_Comm comm) {
    return balance_over(comm, points, options, previous);
}

void balance_into(Balance& result, const Points& points, const Options& options,
                  const Cuts& previous, MPI_Comm comm) {
    result = balance_over(comm, points, options, previous, std::exchange(result.parts, {}));
}

Balance balance(PointPasses& points, const Options& options, const Cuts& previous, MPI_Comm comm) {
    Participant self = mpi::enter(comm, CallName::balance);
    const double start = MPI_Wtime();
    CheckedPasses checked(points);
    Balance result = balance(checked, options, given(previous), true, self);
    print_line(result, options, start, self);
    // The last passes may fail, which no other message carries.
    agree(self);
    return result;
}

}  // namespace rrcb
