#include "gather/kept_parts_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "gather/keeping.hpp"
#include "options/stage_scope.hpp"

#include <algorithm>
#include <utility>

namespace rrcb {

void KeptParts::prepare(const Options& options, bool is_spread, const Points& points, bool may_keep,
                        int rank, int num_ranks, Contribution& mine) {
    is_central_ = !is_spread && reads_kept_tree(options, num_ranks);
    is_spread = is_spread && may_keep_parts(options, num_ranks);
    if (!is_spread && !(is_central_ && may_keep)) return;
    const Extent extent = extent_of(points, mine.summary.box, mine.summary.weight);
    if (is_spread) {
        extents_.emplace(options, extent, may_keep, points.dimension, rank);
    } else {
        append_extent(extent, points.dimension, mine.extents);
    }
}

void KeptParts::read(const Verdict& verdict, const Balance& estimate, Participant& self) {
    const Report& report = estimate.report;
    imbalance_ = verdict.kept_imbalance;
    if (!extents_ || report.details.num_points == 0) return;
    auto parts = extents_->read(weight_of(report), report.details.all_weights_zero, self);
    if (!parts) return;
    spread_ = std::move(*parts);
    imbalance_ = spread_.imbalance;
}

bool KeptParts::are_good(double tolerance) const {
    return keeps_at_once(imbalance_, tolerance);
}

bool KeptParts::do_as_well_as(double imbalance, const Options& options) const {
    return imbalance_ < not_kept && !is_worth_moving(imbalance_, imbalance, options);
}

void KeptParts::keep(const Options& options, Decision& decision, Balance& result,
                     Participant& self) {
    Report& report = result.report;
    report.kept = true;
    report_measured(imbalance_, options.imbalance_tolerance, report);
    if (!extents_) return keep_central(options, decision, result, self);
    agree(self);
    std::ranges::fill(result.parts, static_cast<Part>(mpi::rank_of(self.comm)));
    result.cuts = std::move(spread_.cuts);
    report.part_weights.clear();
    report.details.coincident_cuts = mpi::sum_of(spread_.num_divided, self.comm);
}

void KeptParts::keep_central(const Options& options, Decision& decision, Balance& result,
                             Participant& self) const {
    const bool was_told = decision.verdict.keeps != 0;
    const StageScope stage(options.observer, was_told ? Stage::assignment : Stage::broadcast,
                           self.arithmetic);
    if (was_told) {
        agree(self);
    } else {
        broadcast_kept(decision, self);
    }
    KeptTree& kept = decision.kept;
    std::ranges::fill(result.parts, kept.parts[mpi::rank_of(self.comm)]);
    result.cuts = std::move(kept.cuts);
    result.report.part_weights = std::move(kept.part_weights);
    result.report.details.coincident_cuts = static_cast<int>(
        std::ranges::count_if(result.cuts.tree, [](const Cut& cut) { return cut.divides != 0; }));
}

}  // namespace rrcb
