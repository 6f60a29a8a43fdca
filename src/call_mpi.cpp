#include "call_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/machines_mpi.hpp"
#include "collective/stage_scope.hpp"
#include "cuts/tree.hpp"
#include "lists/duplicated_mpi.hpp"
#include "options/call_kind.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <utility>

namespace rrcb {

Ranks ranks_of(Participant& self) {
    const mpi::Machines machines = mpi::machines_of(self);
    return {mpi::size_of(self.comm), machines.num_ranks, machines.dealt};
}

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

void estimate(Call& call, Participant& self) {
    {
        const StageScope stage(call.options.observer, Stage::gather, self.arithmetic);
        merge_up(call.mine, call.points.dimension(), MergeTree{mpi::size_of(self.comm)},
                 most_cells(call.options), self);
    }
    const Options& options = call.options;
    decide_together(call.mine, options.observer, call.decision, self,
                    [&] { decide(call.mine, options, call.decision); });
    call.result.report = report_of(call.decision.verdict, options.num_parts, options.part_sizes);
    call.result.cuts = std::move(call.decision.cuts);
    call.points.use_weights(!call.decision.verdict.is_counted());
}

void hold_cuts(Call& call, Participant& self) {
    const StageScope stage(call.options.observer, Stage::broadcast, self.arithmetic);
    Cuts& cuts = call.result.cuts;
    Report& report = call.result.report;
    join_cuts(cuts.tree, self);
    if (report.details.num_points > 0)
        report.part_weights =
            part_weights(call.host->points(), call.host->parts_here(), cuts.num_parts, self);
}

namespace {

void report_near(Call& call) {
    const NearCuts& near = call.decision.verdict.near;
    ReportDetails& details = call.result.report.details;
    call.result.cuts.near = {near.reach, 0};
    details.near_after = near.share;
    if (call.decision.verdict.answer == Answer::weights) details.near_before = near.share;
}

}  // namespace

void complete(Call& call) {
    if (!call.is_spread) report_near(call);
    const Cuts& cuts = call.result.cuts;
    std::vector<double>& of_parts = call.result.report.part_weights;
    if (call.decision.verdict.is_counted())
        for (double& weight : of_parts) weight *= call.decision.verdict.unit();
    if (cuts.shape.dealt == 0) return;
    std::vector<Part> numbers(static_cast<std::size_t>(cuts.num_parts));
    for (Part end = 0; end < cuts.num_parts; ++end) numbers[end] = part_at(cuts, end);
    call.points.renumber(numbers);
    std::vector<double>& of_ends = call.options.part_sizes;
    if (of_parts.empty()) return;
    std::ranges::copy(of_parts, of_ends.begin());
    for (Part end = 0; end < cuts.num_parts; ++end) of_parts[part_at(cuts, end)] = of_ends[end];
}

}  // namespace rrcb
