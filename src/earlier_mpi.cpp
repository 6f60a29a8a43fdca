#include "bisection/limited_bisection.hpp"
#include "call_mpi.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/stage_scope.hpp"
#include "cuts/cut_limits.hpp"
#include "estimate/better_mpi.hpp"
#include "estimate/earlier_cuts.hpp"
#include "estimate/keeping.hpp"
#include "estimate/near_points.hpp"
#include "options/call_kind.hpp"
#include "passes/host_passes.hpp"
#include "spread_reuse_mpi.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace rrcb {

namespace {

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
    const PointSummary summary = points.summary(!counts_earlier_parts(given));
    call.box = summary.box;
    introduce(given, summary, &previous, call, self);
    if (!may_reuse(previous, call)) return;
    const Options& options = call.options;
    const Cuts& cuts = take_earlier(call.decision, options, call.is_spread, previous);
    if (call.is_spread) {
        earlier.totals = call.host->assign_known(cuts);
        earlier.spread.emplace(cuts, earlier.totals, is_whole(previous), options,
                               call.host->points(), call.host->parts_here(), self.comm);
        return;
    }
    if (counts_earlier_parts(options)) earlier.totals = {points.assign(cuts, true)};
    call.settlement.prepare(options, false, are_cuts_limited(options), self);
    const double reach = cuts.near.reach;
    const PointSample sample =
        reach > 0 ? points.sample(sample_size(1 << 10, call.ranks.number)) : PointSample{};
    add_totals(earlier.totals, near_share(cuts, sample, reach), call.mine);
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
    if (counts_earlier_parts(options))
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

/// Makes cuts anew from samples only, and returns whether they save ghosts. Collective.
bool sample_saves_ghosts(const Cuts& reused, const PointSample& sample, PointPasses& points,
                         Options options, Participant& self) {
    const int dimension = points.dimension();
    std::vector<double> coordinates;
    std::vector<double> weights;
    self.attempt([&] {
        const std::size_t size = std::max<std::size_t>(1, sample.positions.size());
        const double scale = static_cast<double>(points.count()) / static_cast<double>(size);
        for (const Vector& x : sample.positions)
            coordinates.insert(coordinates.end(), x.begin(), x.begin() + dimension);
        weights.assign(sample.positions.size(), scale);
        for (std::size_t k = 0; k < sample.weights.size(); ++k) weights[k] *= sample.weights[k];
    });
    HostPasses some(interleaved_points(coordinates, dimension, weights), {});
    options.refine = Refine::none;
    const Balance anew = balance_from_scratch(some, options, false, self);
    return saves_ghosts(reused, anew.cuts, sample, points.count(), self);
}

}  // namespace

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
    const double near_now = call.decision.verdict.near_per_cut;
    const bool may_save = may_save_ghosts(call.options, previous.near, near_now);
    const double chosen = may_save ? 0 : previous.near.share;
    call.result.cuts.near.share = reference(chosen, near_now, !is_kept);
    const bool may_be_better =
        may_be_poor(report.imbalance, report.details.least_imbalance, call.options);
    if (!may_save && !may_be_better) return std::move(call.result);
    PointSample sample;
    if (may_save)
        self.attempt([&] { sample = points.sample(sample_size(1 << 13, call.ranks.number)); });
    if (!may_be_better && !sample_saves_ghosts(call.result.cuts, sample, points, given, self))
        return std::move(call.result);
    std::vector<Part> parts;
    self.attempt([&] { parts = points.parts(); });
    Balance anew = balance_from_scratch(points, given, false, self);
    if (may_save) self.attempt([&] { sample = points.sample(1 << 14); });
    return better(std::move(call.result), parts, std::move(anew), points, call.options,
                  may_save ? &sample : nullptr, self);
}

}  // namespace rrcb
