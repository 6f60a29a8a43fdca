#include "balance_mpi.hpp"

#include "bisection/limited_bisection.hpp"
#include "collective/communicator.hpp"
#include "cuts/cut_limits.hpp"
#include "cuts/direct_assignment.hpp"
#include "gather/decision_mpi.hpp"
#include "gather/earlier_cuts.hpp"
#include "gather/keeping.hpp"
#include "gather/merge_tree_mpi.hpp"
#include "options/validation.hpp"
#include "search/refinement_mpi.hpp"
#include "spread_reuse_mpi.hpp"
#include "stage_scope.hpp"
#include "wide_mpi.hpp"

#include <rrcb/balance.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace rrcb {

namespace {

/// State of a call on one rank.
struct Work {
    Options options;
    BinnedPoints binned;
    Contribution mine;
    Decision decision;
    PartTotals totals;  ///< of this rank, by earlier cuts
    PartSums sums;      ///< where parts are counted
    std::optional<Refinement> refinement;
    /// Where many ranks make the parts, what was asked for: the options above are for regions.
    std::optional<Options> whole;
    std::optional<RegionRefinement> below_regions;
    std::optional<SpreadPlaces> places;  ///< where points may stay as they lie
    Balance result;
};

/// Gathers the contributions of all ranks at the root. Collective.
void gather(int dimension, Work& work, Participant& self) {
    const Options& options = work.options;
    Contribution& mine = work.mine;
    const StageScope stage(options.observer, Stage::gather);
    const std::size_t most = most_cells(options);
    merge_up(mine, dimension, MergeTree{mpi::size_of(self.comm)},
             work.whole ? std::min(most, most_cells_of_regions) : most, self);
}

bool is_known(const Verdict& verdict) {
    return !std::isnan(verdict.current_imbalance);
}

/// Completes the options, and tells the other ranks of them and of the points.
void introduce(const Points& points, const Options& given, const Box& box, const Cuts* previous,
               Work& work, const Participant& self) {
    Options& options = work.options = complete(given, mpi::size_of(self.comm));
    check_options(options, points.dimension);
    if (previous) check_previous(*previous, options, points.dimension);
    work.mine.summary = summarize(points, box);
    work.mine.summary.request = request_of(options, points.dimension, previous);
    if (is_wide(options, mpi::size_of(self.comm))) {
        if (!options.part_sizes.empty()) normalize(options.part_sizes, options.num_parts);
        work.whole = std::exchange(options, region_options(options));
    }
    normalize(options.part_sizes, options.num_parts);
}

/// Makes room for the points' parts and for what a refinement needs.
void make_room_for_parts(const Points& points, bool counts, Work& work, const Participant& self) {
    const Options& options = work.options;
    work.result.parts.resize(points.count);
    if (is_refined(options) || counts) work.sums = PartSums(options.part_sizes.size());
    if (is_refined(options)) work.refinement.emplace(options, self, work.sums);
    if (work.whole) work.below_regions.emplace(self);
}

/// Everything before the first message. Not collective.
void prepare(const Points& points, const Options& given, bool may_stay, Work& work,
             const Participant& self) {
    const StageScope stage(given.observer, Stage::moments);
    const Box box = check_points(points);
    introduce(points, given, box, nullptr, work, self);
    const Options& options = work.options;
    const bool reads_current = reads_current_parts(options, mpi::size_of(self.comm));
    make_room(work.decision, options, points.dimension, reads_current);
    make_room_for_parts(points, reads_current, work, self);
    if (work.whole && may_keep_parts(*work.whole, mpi::size_of(self.comm)))
        work.places.emplace(*work.whole, place_of(points, box, work.mine.summary.weight), may_stay,
                            points.dimension, mpi::rank_of(self.comm));
    work.binned = bin_by_options(points, box, options);
    add_records(points, work.binned, work.mine);
    if (reads_current && may_stay)
        append_place(place_of(points, box, work.mine.summary.weight), points.dimension,
                     work.mine.places);
}

/// The same where earlier cuts may stay: assigns the points by them, and counts the parts.
void prepare_to_reuse(const Points& points, const Options& given, const Cuts& previous, Work& work,
                      const Participant& self) {
    const StageScope stage(given.observer, Stage::assignment);
    check_arrays(points);
    introduce(points, given, Box{}, &previous, work, self);
    make_room_to_reuse(work.decision, work.options, previous);
    make_room_for_parts(points, are_cuts_limited(work.options), work, self);
    if (!counts_earlier_parts(work.options)) {
        check_points(points);
        return;
    }
    work.totals = assign_and_count(work.decision.bisection.cuts, points, work.result.parts);
    const PartTotals& totals = work.totals;
    if (!totals.all_finite) reject_coordinates(points);
    work.mine.part_totals = totals.weights;
    work.mine.part_totals.insert(work.mine.part_totals.end(), totals.counts.begin(),
                                 totals.counts.end());
}

/// The same where no rank looks at all cuts. Leaves `reuse` empty if the options rule it out.
void prepare_to_reuse_spread(const Points& points, const Options& given, const Cuts& previous,
                             Work& work, std::optional<SpreadReuse>& reuse,
                             const Participant& self) {
    const StageScope stage(given.observer, Stage::assignment);
    check_arrays(points);
    introduce(points, given, Box{}, &previous, work, self);
    if (!work.whole || work.whole->refine == Refine::exact || work.whole->axes.order.is_given())
        return;
    work.decision.reuses = true;
    work.result.parts.resize(points.count);
    reuse.emplace(previous, work.options.axes.plain, points, work.result.parts, self.comm);
    if (!reuse->all_finite()) reject_coordinates(points);
}

/// Assigns the points by the cuts as they are, and counts the parts where the cuts are earlier ones
/// or the ranks hold parts that may be as good. Collective.
void assign_together(const Points& points, Work& work, Participant& self) {
    const StageScope stage(work.options.observer, Stage::assignment);
    Balance& result = work.result;
    const bool counts = is_known(work.decision.verdict) || work.decision.reuses;
    Points counted = points;
    if (result.report.details.all_weights_zero) counted.weights = {};
    self.attempt([&] {
        if (!counts) return assign(result.cuts, points, result.parts);
        const PartTotals totals = assign_and_count(result.cuts, counted, result.parts);
        std::ranges::copy(totals.weights, work.sums.here().begin());
    });
    if (!counts) return agree(self);
    const double imbalance = work.sums.add_up(work.options.part_sizes, self);
    report_measured(imbalance, work.sums.take(), work.options, result.report);
}

/// Moves the cuts by what the ranks count, and assigns the points by them. Collective.
void refine_together(const Points& points, const Bin& bin, Work& work, Participant& self) {
    const Options& options = work.options;
    const StageScope stage(options.observer, Stage::refinement);
    Balance& result = work.result;
    Report& report = result.report;
    Points counted = points;
    if (report.details.all_weights_zero) counted.weights = work.binned.points.weights = {};
    Decision& decision = work.decision;
    Estimate estimate{std::move(result.cuts),
                      std::move(decision.bisection.brackets),
                      weight_of(report),
                      decision.verdict.common_weight,
                      decision.verdict.current_imbalance,
                      !decision.part_weights.empty(),
                      decision.verdict.heaviest,
                      decision.reuses,
                      decision.box.empty() ? Box{} : decision.box[0]};
    Refined refined =
        work.refinement->refine(std::move(estimate), counted, bin, result.parts, self);
    report_measured(refined.imbalance, work.sums.take(), options, report);
    report.details.rounds = refined.rounds;
    report.details.coincident_cuts = refined.coincident_cuts;
    result.cuts = std::move(refined.cuts);
}

/// Searches cuts from earlier ones on, of points in `box` here and in `whole` on all ranks.
/// Collective.
void search_from_earlier(const Points& points, const Box& box, const Box& whole, Work& work,
                         Participant& self) {
    bracket_earlier(work.result.cuts, whole, work.decision.bisection.brackets);
    // A correction of all cuts at once needs no cells.
    const auto bin = [&]() -> const BinnedPoints& {
        Points counted = points;
        if (work.result.report.details.all_weights_zero) counted.weights = {};
        if (work.binned.cells.empty()) work.binned = bin_by_options(counted, box, work.options);
        return work.binned;
    };
    refine_together(points, std::ref(bin), work, self);
}

/// Moves earlier cuts to where limits let them lie, and searches them there. Collective.
void reuse_within_limits(const Points& points, Work& work, Participant& self) {
    const Box box = bounding_box(points);
    const Box whole = box_together(box, self);
    self.attempt([&] { move_into_places(whole, work.options, work.result.cuts); });
    if (!is_refined(work.options)) return assign_together(points, work, self);
    work.decision.box[0] = whole;
    search_from_earlier(points, box, whole, work, self);
}

/// Ends with earlier cuts where their parts are even enough, or moves them. Collective.
void reuse_together(const Points& points, Work& work, Participant& self) {
    const Options& options = work.options;
    Report& report = work.result.report;
    if (report.details.num_points == 0) return;
    if (are_cuts_limited(options)) return reuse_within_limits(points, work, self);
    const bool is_good = report.imbalance <= options.imbalance_tolerance;
    if (is_good || !is_refined(options)) {
        report.details.rounds = is_refined(options) ? 1 : 0;
        report_measured(report.imbalance, std::move(work.decision.part_weights), options, report);
        return;
    }
    const Box box = bounding_box(points);
    const Box whole = box_together(box, self);
    if (counts_earlier_parts(options))
        work.sums.set(report.details.all_weights_zero ? work.totals.counts : work.totals.weights,
                      work.decision.part_weights);
    search_from_earlier(points, box, whole, work, self);
}

/// Leaves the points in the parts that they lie in. Not collective.
void stay(Work& work, const Participant& self) {
    CurrentParts& current = work.decision.current;
    Balance& result = work.result;
    const auto rank = static_cast<std::size_t>(mpi::rank_of(self.comm));
    std::ranges::fill(result.parts, current.parts[rank]);
    result.cuts = std::move(current.cuts);
    result.report.kept = true;
    result.report.details.coincident_cuts = static_cast<int>(
        std::ranges::count_if(result.cuts.tree, [](const Cut& cut) { return cut.divides != 0; }));
    report_measured(work.decision.verdict.current_imbalance, std::move(current.part_weights),
                    work.options, result.report);
}

/// Makes the parts, or leaves them as they are. Collective.
void divide_together(const Points& points, Work& work, Participant& self) {
    const Report& report = work.result.report;
    const Verdict& verdict = work.decision.verdict;
    if (verdict.stays) {
        const StageScope stage(work.options.observer, Stage::assignment);
        stay(work, self);
        return agree(self);
    }
    if (is_refined(work.options) && report.details.num_points > 0) {
        const auto bin = [&]() -> const BinnedPoints& { return work.binned; };
        refine_together(points, std::ref(bin), work, self);
    } else {
        assign_together(points, work, self);
    }
    if (!is_known(verdict)) return;
    if (is_worth_moving(verdict.current_imbalance, report.imbalance, work.options)) return;
    const StageScope stage(work.options.observer, Stage::broadcast);
    broadcast_current(work.decision, self);
    stay(work, self);
}

/// Makes the parts by many ranks, or leaves them as they are. Collective.
void divide_among_many(const Points& points, Work& work, Participant& self) {
    const Options& options = *work.whole;
    const Verdict& verdict = work.decision.verdict;
    Balance& result = work.result;
    auto held = read_held(work.places, result.report, *work.below_regions, self);
    if (held && stays_at_once(held->imbalance, options.imbalance_tolerance))
        return stay_spread(options, verdict.heaviest, std::move(*held), result, self);
    divide_together(points, work, self);
    work.refinement.reset();
    if (result.report.details.all_weights_zero) work.binned.points.weights = {};
    refine_regions(options, verdict, work.mine.summary.box, work.binned, *work.below_regions,
                   result, self);
    if (held && !is_worth_moving(held->imbalance, result.report.imbalance, options))
        stay_spread(options, verdict.heaviest, std::move(*held), result, self);
}

/// True when parts are so uneven that the axes of earlier cuts, which stay, may be why.
bool may_be_poor(const Report& report, const Options& options) {
    constexpr double factor = 1.25;
    const double within_reach =
        std::max(options.imbalance_tolerance, report.details.least_imbalance);
    return is_refined(options) && !are_cuts_limited(options) &&
           report.imbalance > factor * within_reach;
}

/// Ends with earlier cuts where their parts are even enough, or balances from nothing; no rank
/// looks at all cuts. Collective.
Balance reuse_spread(const Points& points, const Options& given, const Cuts& previous,
                     bool may_stay, Participant& self) {
    Work work;
    work.options.observer = given.observer;
    std::optional<SpreadReuse> reuse;
    self.attempt([&] { prepare_to_reuse_spread(points, given, previous, work, reuse, self); });
    // Both begin with the same messages, so that ranks meet there where one has failed.
    if (!self.failed() && !reuse)
        return balance_once(points, given, nullptr, may_stay, self).balance;
    gather(points.dimension, work, self);
    decide_together(work.mine, work.options, work.decision, self);
    const Verdict& verdict = work.decision.verdict;
    work.result.report = report_of(verdict, work.whole->num_parts);
    if (!reuse->ends(*work.whole, verdict.heaviest, work.result, self))
        return balance_once(points, given, nullptr, may_stay, self).balance;
    hold_cuts(points, *work.whole, work.result, self);
    return std::move(work.result);
}

}  // namespace

Outcome balance_once(const Points& points, const Options& given, const Cuts* previous,
                     bool may_stay, Participant& self) {
    if (previous && reuses_spread(*previous, given, mpi::size_of(self.comm)))
        return {reuse_spread(points, given, *previous, may_stay, self)};
    Work work;
    work.options.observer = given.observer;
    self.attempt([&] {
        previous ? prepare_to_reuse(points, given, *previous, work, self)
                 : prepare(points, given, may_stay, work, self);
    });
    gather(points.dimension, work, self);
    decide_together(work.mine, work.options, work.decision, self);
    const int num_parts = work.whole ? work.whole->num_parts : work.options.num_parts;
    work.result.report = report_of(work.decision.verdict, num_parts);
    work.result.cuts = std::move(work.decision.bisection.cuts);
    if (work.whole) {
        divide_among_many(points, work, self);
        hold_cuts(points, *work.whole, work.result, self);
    } else {
        previous ? reuse_together(points, work, self) : divide_together(points, work, self);
    }
    const bool is_poor = previous && may_be_poor(work.result.report, work.options);
    return {std::move(work.result), is_poor};
}

}  // namespace rrcb
