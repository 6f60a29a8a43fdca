#include "bisection/limited_bisection.hpp"
#include "call_mpi.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/stage_scope.hpp"
#include "cuts/cut_limits.hpp"
#include "estimate/earlier_cuts.hpp"
#include "estimate/keeping_mpi.hpp"
#include "lists/duplicated_mpi.hpp"
#include "options/call_kind.hpp"
#include "passes/host_passes.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rrcb {

namespace {

/// Counts the parts of the earlier cuts in a call in which many ranks make the parts. Returns
/// whether the cuts are kept, because their parts are within the tolerance; then it completes the
/// report. Collective: a reduction with an entry for each part, and a broadcast.
bool keeps_spread(Call& call, Participant& self) {
    Report& report = call.result.report;
    if (report.details.num_points == 0) return true;
    std::vector<double> weights = part_weights(call.host->points(), call.host->parts_here(),
                                               call.result.cuts.num_parts, self);
    double worst = imbalance(weights, call.options.part_sizes);
    mpi::broadcast(std::as_writable_bytes(std::span(&worst, 1)), root, self.comm);
    report_measured(worst, call.options.imbalance_tolerance, report);
    report.details.rounds = 1;
    report.part_weights = std::move(weights);
    return report.within_tolerance;
}

/// Returns true if the call may begin with earlier cuts.
bool may_reuse(const Call& call) {
    return !call.is_spread ||
           (call.options.refine != Refine::exact && !call.options.axes.order.is_given());
}

/// Prepares a call from earlier cuts: assigns the points by them, and counts the parts if they may
/// be kept and rank 0 weighs them. Not collective.
void prepare_to_reuse(const Options& given, const Cuts& previous, Call& call,
                      const Participant& self) {
    const StageScope stage(given.observer, Stage::assignment, self.arithmetic);
    PointPasses& points = call.points;
    points.use_weights(true);
    const PointSummary summary = points.summary(!counts_earlier_parts(given));
    call.box = summary.box;
    introduce(given, summary, &previous, call, self);
    if (!may_reuse(call)) return;
    const Options& options = call.options;
    take_earlier(call.decision, options, call.is_spread, previous);
    const Cuts& cuts = call.decision.cuts;
    if (call.is_spread) {
        points.assign(cuts, false);
        return;
    }
    PartTotals totals;
    if (counts_earlier_parts(options)) totals = points.assign(cuts, true);
    prepare_to_settle(call, are_cuts_limited(options), self);
    const double reach = cuts.near.reach;
    const PointSample sample =
        reach > 0 ? points.sample(sample_size(1 << 10, call.ranks.number)) : PointSample{};
    add_totals(totals, near_share(cuts, sample, reach), call.mine);
}

/// Returns true if the cuts whose parts rank 0 weighed are kept; completes the report then.
bool keeps_earlier(Call& call) {
    const Options& options = call.options;
    Report& report = call.result.report;
    if (report.details.num_points == 0) return true;
    if (are_cuts_limited(options)) return false;
    // An uncounted imbalance is NaN; > would raise a floating-point exception.
    if (is_refined(options) && !std::islessequal(report.imbalance, options.imbalance_tolerance))
        return false;
    report.details.rounds = is_refined(options) ? 1 : 0;
    report_measured(report.imbalance, options.imbalance_tolerance, report);
    report.part_weights = std::move(call.decision.part_weights);
    return true;
}

/// Moves the earlier cuts, first to allowed positions if there are limits. Collective.
void settle_from_earlier(Call& call, Participant& self) {
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
    if (is_refined(options) && counts_earlier_parts(options))
        std::ranges::copy(decision.part_weights, call.sums.sums().begin());
    if (is_refined(options)) bracket_earlier(call.result.cuts, whole, decision.brackets);
    settle(call, true, self);
}

bool are_same(const Cuts& a, const Cuts& b) {
    return std::ranges::equal(a.tree, b.tree, [](const Cut& one, const Cut& other) {
        return one.axis == other.axis && one.at == other.at;
    });
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
    self.attempt([&] { prepare_to_reuse(given, previous, call, self); });
    // Both ways begin with the same messages, so a failed rank does not wait alone.
    if (!self.failed() && !may_reuse(call))
        return balance_from_scratch(points, given, may_keep, self);
    estimate(call, self);
    if (call.is_spread) {
        if (!keeps_spread(call, self)) return balance_from_scratch(points, given, may_keep, self);
        complete(call);
        return std::move(call.result);
    }
    const bool is_kept = keeps_earlier(call);
    if (!is_kept) settle_from_earlier(call, self);
    self.attempt([&] { complete(call); });
    const Report& report = call.result.report;
    const double near_now = call.decision.verdict.near_per_cut;
    const bool may_save = may_save_ghosts(call.options, previous.near, near_now);
    const double chosen = may_save ? 0 : previous.near.share;
    const bool are_moved = !is_kept && !are_same(call.result.cuts, previous);
    call.result.cuts.near.share = reference(chosen, near_now, are_moved);
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
