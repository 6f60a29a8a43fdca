#include "held_parts_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "gather/keeping.hpp"
#include "options/stage_scope.hpp"

#include <algorithm>
#include <utility>

namespace rrcb {

void HeldParts::prepare(const CallOptions& options, const Points& points, bool may_stay, int rank,
                        int num_ranks, Contribution& mine) {
    is_central_ = reads_current_parts(options.central(), num_ranks);
    const bool is_spread = options.is_spread() && may_keep_parts(options.parts, num_ranks);
    if (!is_spread && !(is_central_ && may_stay)) return;
    const Place place = place_of(points, mine.summary.box, mine.summary.weight);
    if (is_spread) {
        places_.emplace(options.parts, place, may_stay, points.dimension, rank);
    } else {
        append_place(place, points.dimension, mine.places);
    }
}

void HeldParts::read(const Verdict& verdict, const Report& report, Participant& self) {
    imbalance_ = verdict.current_imbalance;
    if (!places_ || report.details.num_points == 0) return;
    auto parts = places_->read(weight_of(report), report.details.all_weights_zero, self);
    if (!parts) return;
    spread_ = std::move(*parts);
    imbalance_ = spread_.imbalance;
}

bool HeldParts::are_good(double tolerance) const {
    return stays_at_once(imbalance_, tolerance);
}

bool HeldParts::do_as_well_as(double imbalance, const Options& options) const {
    return is_known(imbalance_) && !is_worth_moving(imbalance_, imbalance, options);
}

void HeldParts::keep(const CallOptions& options, Decision& decision, Balance& result,
                     Participant& self) {
    Report& report = result.report;
    report.kept = true;
    report_measured(imbalance_, options.parts.imbalance_tolerance, report);
    if (!places_) return keep_central(options, decision, result, self);
    agree(self);
    std::ranges::fill(result.parts, static_cast<Part>(mpi::rank_of(self.comm)));
    result.cuts = std::move(spread_.cuts);
    report.part_weights.clear();
    report.details.coincident_cuts = mpi::sum_of(spread_.num_divided, self.comm);
}

void HeldParts::keep_central(const CallOptions& options, Decision& decision, Balance& result,
                             Participant& self) const {
    const bool was_told = decision.verdict.stays != 0;
    const StageScope stage(options.parts.observer, was_told ? Stage::assignment : Stage::broadcast);
    if (was_told) {
        agree(self);
    } else {
        broadcast_current(decision, self);
    }
    CurrentParts& current = decision.current;
    const auto rank = static_cast<std::size_t>(mpi::rank_of(self.comm));
    std::ranges::fill(result.parts, current.parts[rank]);
    result.cuts = std::move(current.cuts);
    result.report.part_weights = std::move(current.part_weights);
    result.report.details.coincident_cuts = static_cast<int>(
        std::ranges::count_if(result.cuts.tree, [](const Cut& cut) { return cut.divides != 0; }));
}

}  // namespace rrcb
