#include "balance_mpi.hpp"

#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "cuts/binned_assignment.hpp"
#include "gather/decision_mpi.hpp"
#include "gather/merge_tree_mpi.hpp"
#include "options/stage_scope.hpp"
#include "refinement/refinement_mpi.hpp"

#include <rrcb/balance.hpp>

#include <cmath>
#include <numeric>
#include <optional>

namespace rrcb {

namespace {

/// The options with nothing left to default but the sizes of equal parts.
Options complete(Options options, int num_ranks) {
    if (options.num_parts == 0) options.num_parts = num_ranks;
    if (options.refine == Refine::automatic)
        options.refine = options.domain == DomainKind::sampled ? Refine::none : Refine::tolerance;
    return options;
}

/// Checked sizes of a sum in [1, 2), so that weights over sizes stay in range; equal ones where
/// there are none. By a power of two, so that the ratios keep their bits, but for sizes hundreds of
/// decades below their sum.
void normalize(std::vector<double>& sizes, int num_parts) {
    if (sizes.empty()) sizes.assign(static_cast<std::size_t>(num_parts), 1.0);
    const int exponent = std::ilogb(std::accumulate(sizes.begin(), sizes.end(), 0.0));
    for (double& size : sizes) size = std::ldexp(size, -exponent);
}

/// What all ranks contributed, at the root. Collective.
///
/// The tree is that of every other call. Points have nothing to gain from a stop on the way, so
/// they go straight to the root, as in the paper, once it has told all ranks that all ask for this.
void gather(Contribution& mine, const Options& options, int dimension, Member& me) {
    const StageScope stage(options.observer, Stage::gather);
    merge_up(mine, dimension, MergeTree{mpi::size_of(me.comm)}, most_cells(options), me);
    if (options.domain != DomainKind::points) return;
    confirm(mine.summary, me);
    gather_points(mine.points, me);
}

/// The decision of the root, on every rank; throws what went wrong on one of them on all.
/// Collective.
void decide_together(const Contribution& all, const Options& options, const Cuts* previous,
                     Decision& decision, Member& me) {
    if (mpi::rank_of(me.comm) == root) {
        decision.verdict.failing_rank = all.summary.failing_rank;
        me.locally([&] {
            if (all.summary.failing_rank != no_rank) return;
            const StageScope stage(options.observer, Stage::bisection);
            decide(all, options, previous, decision);
        });
        if (me.failure.failed) decision.verdict.failing_rank = root;
    }
    const StageScope stage(options.observer, Stage::broadcast);
    broadcast(decision, me);
}

/// Assigns the points by the cuts as they are. Collective.
void assign_together(const Options& options, const Points& points, const BinnedPoints& binned,
                     Balance& result, Member& me) {
    const StageScope stage(options.observer, Stage::assignment);
    me.locally([&] {
        if (options.domain == DomainKind::points) {
            assign(result.cuts, points, result.parts);
        } else {
            assign(result.cuts, binned, result.parts);
        }
    });
    agree(me);
}

/// Moves the cuts by what the ranks count, and assigns the points by them. Collective.
void refine_together(Decision& decision, const Options& options, BinnedPoints& binned,
                     RefinementRoom& room, Balance& result, Member& me) {
    const StageScope stage(options.observer, Stage::refinement);
    Report& report = result.report;
    if (report.all_weights_zero) binned.points.weights = {};
    const double weight =
        report.all_weights_zero ? static_cast<double>(report.num_points) : report.total_weight;
    Estimate estimate{std::move(result.cuts), std::move(decision.bisection.brackets), weight,
                      decision.verdict.grain};
    Measured measured = refine(estimate, options, binned, room, result.parts, me);
    report.measured_imbalance = measured.imbalance;
    report.within_tolerance = measured.imbalance <= options.imbalance_tolerance;
    report.part_weights = std::move(measured.part_weights);
    report.rounds = measured.rounds;
    report.coincident_cuts = measured.coincident_cuts;
    result.cuts = std::move(estimate.cuts);
}

}  // namespace

Balance balance(const Points& points, const Options& given, const Cuts* previous, Member& me) {
    Options options;
    options.observer = given.observer;
    Balance result;
    BinnedPoints binned;
    Contribution mine;
    Decision decision;
    std::optional<RefinementRoom> room;
    me.locally([&] {
        const StageScope stage(given.observer, Stage::moments);
        options = complete(given, mpi::size_of(me.comm));
        const Box box = check_points(points);
        check_options(options, points.dimension);
        if (previous) check_previous(*previous, options, points.dimension);
        mine.summary = summarize(points, box);
        mine.summary.request = request_of(options, points.dimension, previous);
        // Not before the ranks are compared by what they were given.
        if (previous) options.domain = DomainKind::analytic;
        normalize(options.part_sizes, options.num_parts);
        make_room(decision, options, points.dimension);
        result.parts.resize(points.count);
        if (is_refined(options))
            room.emplace(options, points.dimension, mpi::rank_of(me.comm) == root);
        binned = bin_by_options(points, box, options);
        if (!previous) add_records(points, binned, options, mine);
    });
    gather(mine, options, points.dimension, me);
    decide_together(mine, options, previous, decision, me);
    result.report = report_of(decision.verdict, options.num_parts);
    result.cuts = std::move(decision.bisection.cuts);
    if (is_refined(options) && result.report.num_points > 0) {
        refine_together(decision, options, binned, *room, result, me);
    } else {
        assign_together(options, points, binned, result, me);
    }
    return result;
}

Balance balance(const Points& points, const Options& options, MPI_Comm comm) {
    Member me{mpi::duplicate_of(comm)};
    return balance(points, options, nullptr, me);
}

Balance balance(const Points& points, const Options& options, MPI_Comm comm, const Cuts& previous) {
    Member me{mpi::duplicate_of(comm)};
    return balance(points, options, &previous, me);
}

}  // namespace rrcb
