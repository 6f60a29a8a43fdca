#include "settlement_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/stage_scope.hpp"
#include "lists/duplicated_mpi.hpp"
#include "lists/tier_search_mpi.hpp"
#include "options/call_kind.hpp"
#include "passes/assignment.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace rrcb {

namespace {

/// Returns the cuts above each of these points, and those known before. Collective.
Cuts with_cuts_above(const Points& points, const Cuts& known, Participant& self) {
    std::vector<Part> parts;
    std::optional<SearchBuffers<PathSearch>> buffers;
    self.attempt([&] {
        parts.resize(points.count);
        assign_known(known, points, parts);
        buffers.emplace(PathSearch(known, points, parts), self.comm);
    });
    agree(self);
    search_together(*buffers, self);
    return buffers->search.take();
}

}  // namespace

void Settlement::prepare(const Options& options, bool is_spread, bool counts,
                         const Participant& self) {
    options_ = &options;
    if (is_spread) {
        of_many_.emplace(self);
        return;
    }
    if (is_refined(options) || counts) sums_ = PartSums(options.part_sizes.size());
    if (is_refined(options)) refinement_.emplace(options, self, sums_);
}

void Settlement::assign(PointPasses& points, bool counts, Balance& result, Participant& self) {
    const StageScope stage(options_->observer, Stage::assignment, self.arithmetic);
    self.attempt([&] {
        const PartTotals totals = points.assign(result.cuts, counts);
        if (counts) std::ranges::copy(totals.weights, sums_.here().begin());
    });
    if (!counts) return agree(self);
    const double imbalance = sums_.add_up(options_->part_sizes, self);
    report_measured(imbalance, options_->imbalance_tolerance, result.report);
    result.report.part_weights = sums_.take();
}

void Settlement::take_counts(std::span<const double> here, std::span<const double> sums) {
    sums_.set(here, sums);
}

void Settlement::refine(PointPasses& points, const Box& box, Decision& decision, Balance& result,
                        Participant& self) {
    const StageScope stage(options_->observer, Stage::refinement, self.arithmetic);
    Report& report = result.report;
    const Verdict& verdict = decision.verdict;
    // Kept parts would still be sent.
    if (!(verdict.kept_imbalance < not_kept)) decision.message = std::vector<std::byte>();
    Estimate estimate{std::move(result.cuts),
                      std::move(decision.bisection.brackets),
                      verdict.weight(),
                      verdict.is_counted() ? 1.0 : 0.0,
                      verdict.kept_imbalance,
                      !decision.part_weights.empty(),
                      verdict.heaviest,
                      verdict.answer == Answer::weights,
                      verdict.box,
                      report.details.num_points,
                      report.details.least_imbalance};
    Refined refined = refinement_->refine(std::move(estimate), points, box, self);
    report_measured(refined.imbalance, options_->imbalance_tolerance, report);
    report.part_weights = sums_.take();
    report.details.rounds = refined.rounds;
    report.details.coincident_cuts = refined.coincident_cuts;
    result.cuts = std::move(refined.cuts);
}

void Settlement::search(HostPasses& points, const Verdict& verdict, Balance& result,
                        Participant& self) {
    const StageScope stage(options_->observer, Stage::refinement, self.arithmetic);
    Report& report = result.report;
    PartTree tree = tree_of(*options_, mpi::size_of(self.comm));
    tree.weight = verdict.weight();
    tree.rule.common_weight = verdict.is_counted() ? 1 : 0;
    tree.rule.heaviest = verdict.heaviest;
    Refined refined = of_many_->refine(verdict.box, tree, points, self);
    agree(self);
    result.cuts = std::move(refined.cuts);
    if (report.details.num_points > 0)
        report_measured(refined.imbalance, options_->imbalance_tolerance, report);
    report.details.rounds = refined.rounds;
    report.details.coincident_cuts = refined.coincident_cuts;
}

void hold_cuts(HostPasses& points, const Options& options, Balance& result, Participant& self) {
    Report& report = result.report;
    const bool gets_all = options.cuts == HeldCuts::whole;
    const bool divides =
        options.coincident == Coincident::divide && report.details.coincident_cuts > 0;
    if (!gets_all && !divides) return;
    const StageScope stage(options.observer, Stage::broadcast, self.arithmetic);
    if (!gets_all) {
        result.cuts = with_cuts_above(points.points(), result.cuts, self);
        return;
    }
    if (!is_whole(result.cuts)) result.cuts = gather_cuts(result.cuts, self);
    if (report.details.num_points == 0) return;
    report.part_weights =
        part_weights(points.points(), points.parts_here(), result.cuts.num_parts, self);
}

}  // namespace rrcb
