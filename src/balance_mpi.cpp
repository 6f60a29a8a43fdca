#include "balance_mpi.hpp"

#include "bisection/limited_bisection.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/machines_mpi.hpp"
#include "cuts/cut_limits.hpp"
#include "cuts/tree.hpp"
#include "gather/better_mpi.hpp"
#include "gather/earlier_cuts.hpp"
#include "gather/keeping.hpp"
#include "gather/merge_tree_mpi.hpp"
#include "gather/spread_reuse_mpi.hpp"
#include "options/call_kind.hpp"
#include "options/rejection.hpp"
#include "options/stage_scope.hpp"
#include "passes/assignment.hpp"
#include "passes/host_passes.hpp"
#include "settlement_mpi.hpp"
#include "verbose_mpi.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

// A call has five steps:
//   prepare    checks options and points, and allocates memory for all messages
//   estimate   rank 0 bisects the cells of all ranks, or weighs the parts of earlier cuts, or only
//              adds up the points if many ranks make the parts
//   keep?      are the parts that the ranks hold, or those of the earlier cuts, even enough?
//   settle     if not, the cuts move by counts of all ranks
//   report     imbalance, and the weight of each part
// Only prepare may fail on one rank; all ranks receive that failure with the estimate.

namespace rrcb {

namespace {

/// A call on one rank.
struct Call {
    Call(PointPasses& given, StageObserver* observer, Participant& self)
        : points(given), host(dynamic_cast<HostPasses*>(&given)), ranks(ranks_of(self)) {
        options.observer = observer;
    }

    PointPasses& points;
    HostPasses* host;  ///< null if only passes read the points
    Ranks ranks;
    Options options;  ///< complete; sizes are normalized, but none if many ranks make equal parts
    bool is_spread = false;  ///< many ranks make the parts
    Contribution mine;
    Decision decision;
    Box box;  ///< of the points of this rank
    Settlement settlement;
    Balance result;
};

/// Completes the options, and summarizes them and the points for the other ranks.
void introduce(const Options& given, const PointSummary& summary, const Cuts* previous, Call& call,
               const Participant& self) {
    const int dimension = call.points.dimension();
    Options options = complete(given, call.ranks, previous);
    check_options(options, dimension);
    call.is_spread = is_spread(options, call.ranks.number);
    require(options.tree.dealt == 0 || !call.is_spread,
            "tree.dealt must be 0 if many ranks make the parts; raise tuning.central_parts");
    require(
        call.host || !call.is_spread,
        "many ranks make the parts, which takes points on the host; raise tuning.central_parts");
    if (previous) check_previous(*previous, options, dimension);
    call.mine.summary = summarize(summary, call.points.has_weights(), mpi::rank_of(self.comm));
    call.mine.summary.request = request_of(options, dimension, previous);
    if (!options.part_sizes.empty() && options.tree.dealt != 0)
        for (Part end = 0; end < options.num_parts; ++end)
            options.part_sizes[end] =
                given.part_sizes[options.tree.part_at(end, options.num_parts)];
    if (!call.is_spread || !options.part_sizes.empty())
        normalize(options.part_sizes, options.num_parts);
    call.options = std::move(options);
}

/// Replaces the ends of the tree by parts, and counts by weights. Overwrites the sizes of the
/// parts.
void complete(Call& call) {
    const Cuts& cuts = call.result.cuts;
    std::vector<double>& of_parts = call.result.report.part_weights;
    if (call.decision.verdict.is_counted())
        for (double& weight : of_parts) weight *= call.decision.verdict.common_weight;
    if (cuts.shape.dealt == 0) return;
    std::vector<Part> numbers(static_cast<std::size_t>(cuts.num_parts));
    for (Part end = 0; end < cuts.num_parts; ++end) numbers[end] = part_at(cuts, end);
    call.points.renumber(numbers);
    std::vector<double>& of_ends = call.options.part_sizes;
    if (of_parts.empty()) return;
    std::ranges::copy(of_parts, of_ends.begin());
    for (Part end = 0; end < cuts.num_parts; ++end) of_parts[part_at(cuts, end)] = of_ends[end];
}

/// Gives every rank the decision of rank 0, or throws the error of one rank on all. Collective.
void estimate(Call& call, Participant& self) {
    {
        const StageScope stage(call.options.observer, Stage::gather, self.arithmetic);
        merge_up(call.mine, call.points.dimension(), MergeTree{mpi::size_of(self.comm)},
                 most_cells(call.options), self);
    }
    const Options& options = call.options;
    decide_together(call.mine, options, call.decision, self);
    call.result.report = report_of(call.decision.verdict, options.num_parts, options.part_sizes);
    call.result.cuts = std::move(call.decision.bisection.cuts);
    call.points.use_weights(!call.decision.verdict.is_counted());
}

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
    call.settlement.prepare(options, call.is_spread, reads_kept, self);
    call.decision.bisects = !call.is_spread;
    if (call.is_spread) return;
    if (reads_kept && may_keep)
        append_extent(extent_of(summary), points.dimension(), call.mine.extents);
    make_buffers(call.decision, options, points.dimension(), reads_kept);
    add_records(points, summary.box, options, call.mine);
}

/// Makes the parts, from the cuts of rank 0 if it makes them. Collective.
void settle(Call& call, Participant& self) {
    Settlement& settlement = call.settlement;
    const Verdict& verdict = call.decision.verdict;
    if (call.is_spread) {
        settlement.search(*call.host, verdict, call.result, self);
    } else if (is_refined(call.options) && verdict.num_points > 0) {
        settlement.refine(call.points, call.box, call.decision, call.result, self);
    } else {
        settlement.assign(call.points, verdict.kept_imbalance < not_kept, call.result, self);
    }
}

/// Makes the parts that the ranks hold the result. Collective.
void keep(Call& call, Participant& self) {
    Decision& decision = call.decision;
    const bool is_known = decision.verdict.keeps != 0;
    const StageScope stage(call.options.observer, is_known ? Stage::assignment : Stage::broadcast,
                           self.arithmetic);
    if (is_known) {
        agree(self);
    } else {
        broadcast_kept(decision, self);
    }
    KeptTree& kept = decision.kept;
    Report& report = call.result.report;
    report.kept = is_in_order(kept);
    report_measured(decision.verdict.kept_imbalance, call.options.imbalance_tolerance, report);
    report.part_weights = std::move(kept.part_weights);
    report.details.coincident_cuts = static_cast<int>(
        std::ranges::count_if(kept.cuts.tree, [](const Cut& cut) { return cut.divides != 0; }));
    const Part part = kept.parts[mpi::rank_of(self.comm)];
    self.attempt([&] { call.points.renumber(std::span(&part, 1)); });
    call.result.cuts = std::move(kept.cuts);
}

void report_near(Call& call) {
    const NearCuts& near = call.decision.verdict.near;
    ReportDetails& details = call.result.report.details;
    call.result.cuts.near = {near.reach, 0};
    details.near_after = near.share;
    if (!call.decision.bisects) details.near_before = near.share;
}

Balance balance_from_scratch(PointPasses& points, const Options& given, bool may_keep,
                             Participant& self) {
    Call call(points, given.observer, self);
    self.attempt([&] { prepare(given, may_keep, call, self); });
    estimate(call, self);
    const Options& options = call.options;
    const double kept = call.decision.verdict.kept_imbalance;
    bool is_kept = keeps_at_once(kept, options.imbalance_tolerance);
    if (!is_kept) {
        settle(call, self);
        is_kept = kept < not_kept && !is_worth_moving(kept, call.result.report.imbalance, options);
    }
    if (is_kept) keep(call, self);
    if (call.is_spread) hold_cuts(*call.host, options, call.result, self);
    self.attempt([&] { complete(call); });
    report_near(call);
    return std::move(call.result);
}

/// Counts of the parts of earlier cuts.
struct EarlierParts {
    KnownTotals totals{};                 ///< of this rank
    std::optional<SpreadReuse> spread{};  ///< if many ranks weigh the parts; else rank 0 does
};

/// Returns true if the call may begin with earlier cuts.
bool may_reuse(const Cuts& previous, const Call& call) {
    if (!call.is_spread) return is_whole(previous);
    return call.options.refine != Refine::exact && !call.options.axes.order.is_given();
}

/// Prepares a call from earlier cuts: assigns the points by them, and counts the parts if they may
/// be kept. Not collective.
void prepare_to_reuse(const Options& given, const Cuts& previous, Call& call, EarlierParts& earlier,
                      const Participant& self) {
    const StageScope stage(given.observer, Stage::assignment, self.arithmetic);
    PointPasses& points = call.points;
    points.use_weights(true);
    introduce(given, points.summary(!counts_earlier_parts(given)), &previous, call, self);
    if (!may_reuse(previous, call)) return;
    const Options& options = call.options;
    const Cuts& cuts = take_earlier(call.decision, options, call.is_spread, previous);
    if (call.is_spread) {
        earlier.totals = call.host->assign_known(cuts);
        earlier.spread.emplace(cuts, earlier.totals, is_whole(previous), options,
                               call.host->points(), call.host->parts_here(), self.comm);
        return;
    }
    if (counts_earlier_parts(options))
        static_cast<PartTotals&>(earlier.totals) = points.assign(cuts, true);
    call.settlement.prepare(options, false, are_cuts_limited(options), self);
    add_totals(earlier.totals, near_share(cuts, points, cuts.near.reach, 1024), call.mine);
}

/// Returns true if the earlier cuts are kept; the report then has their imbalance. Collective if
/// many ranks weigh their parts.
bool keeps_earlier(Call& call, EarlierParts& earlier, Participant& self) {
    if (earlier.spread) return earlier.spread->ends(call.decision.verdict, call.result, self);
    const Options& options = call.options;
    Report& report = call.result.report;
    if (report.details.num_points == 0) return true;
    if (are_cuts_limited(options)) return false;
    // An imbalance that was not counted is NaN; > would raise a floating-point exception.
    if (is_refined(options) && !std::islessequal(report.imbalance, options.imbalance_tolerance))
        return false;
    report.details.rounds = is_refined(options) ? 1 : 0;
    report_measured(report.imbalance, options.imbalance_tolerance, report);
    report.part_weights = std::move(call.decision.part_weights);
    return true;
}

/// Moves the earlier cuts, first to allowed positions if there are limits. Collective.
void settle_from_earlier(Call& call, const EarlierParts& earlier, Participant& self) {
    const Options& options = call.options;
    Decision& decision = call.decision;
    self.attempt([&] { call.box = call.points.summary(true).box; });
    decision.verdict.box = box_together(call.box, self);
    const Box& whole = decision.verdict.box;
    if (are_cuts_limited(options))
        self.attempt([&] {
            CutLimits limits(options, whole, call.result.cuts.dimension);
            limits.require_room();
            move_into_places(limits, call.result.cuts);
        });
    if (!is_refined(options)) return call.settlement.assign(call.points, true, call.result, self);
    if (counts_earlier_parts(options))
        call.settlement.take_counts(
            decision.verdict.is_counted() ? earlier.totals.counts : earlier.totals.weights,
            decision.part_weights);
    bracket_earlier(call.result.cuts, whole, decision.bisection.brackets);
    call.settlement.refine(call.points, call.box, decision, call.result, self);
}

/// Keeps the earlier cuts if they are even enough, else moves them. Begins from scratch if the cuts
/// cannot be reused, or are uneven and many ranks make the parts. If the axes of the earlier cuts
/// may be poor by now, makes cuts from scratch as well and returns the better result. Collective.
Balance balance_from_earlier(PointPasses& points, const Options& given, const Cuts& previous,
                             bool may_keep, Participant& self) {
    Call call(points, given.observer, self);
    EarlierParts earlier;
    self.attempt([&] { prepare_to_reuse(given, previous, call, earlier, self); });
    // Both ways begin with the same messages, so a rank that has failed does not wait alone.
    if (!self.failed() && !may_reuse(previous, call))
        return balance_from_scratch(points, given, may_keep, self);
    estimate(call, self);
    const bool is_kept = keeps_earlier(call, earlier, self);
    if (call.is_spread) {
        if (!is_kept) return balance_from_scratch(points, given, may_keep, self);
        hold_cuts(*call.host, call.options, call.result, self);
        complete(call);
        return std::move(call.result);
    }
    if (!is_kept) settle_from_earlier(call, earlier, self);
    self.attempt([&] { complete(call); });
    const Report& report = call.result.report;
    report_near(call);
    const double near_now = call.decision.verdict.near.share;
    const bool may_save = may_save_ghosts(call.options, previous.near, near_now);
    const double excess = is_kept ? 0 : call.decision.verdict.measured_imbalance - 1;
    call.result.cuts.near.share = reference(previous.near, near_now, excess);
    if (!may_save && !may_be_poor(report.imbalance, report.details.least_imbalance, call.options))
        return std::move(call.result);
    std::vector<Part> parts;
    self.attempt([&] { parts = points.parts(); });
    Balance anew = balance_from_scratch(points, given, false, self);
    return better(std::move(call.result), parts, std::move(anew), points, call.options, may_save,
                  self);
}

}  // namespace

Ranks ranks_of(Participant& self) {
    const mpi::Machines machines = mpi::machines_of(self);
    return {mpi::size_of(self.comm), machines.num_ranks, machines.dealt};
}

Balance balance_once(PointPasses& points, const Options& options, const Cuts* previous,
                     bool may_keep, Participant& self) {
    Balance result = previous ? balance_from_earlier(points, options, *previous, may_keep, self)
                              : balance_from_scratch(points, options, may_keep, self);
    result.cuts.group = mpi::size_of(self.comm) > 1 ? mpi::group_of(self.comm) : 0;
    return result;
}

Balance balance(const Points& points, const Options& options, const Cuts* previous, bool may_keep,
                Participant& self, std::vector<Part> memory) {
    HostPasses host(points, std::move(memory));
    Balance result = balance(host, options, previous, may_keep, self);
    result.parts = host.take_parts();
    result.cuts.points = hash_of(points);
    return result;
}

namespace {

Balance balance_over(MPI_Comm comm, const Points& points, const Options& options,
                     const Cuts& previous, std::vector<Part> memory = {}) {
    Participant self = mpi::enter(comm, CallName::balance);
    Balance result = aloud(self, [&] {
        return balance(points, options, given(previous), true, self, std::move(memory));
    });
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
    Balance result =
        aloud(self, [&] { return balance(points, options, given(previous), true, self); });
    // The last passes may fail, which no other message carries.
    agree(self);
    return result;
}

}  // namespace rrcb
