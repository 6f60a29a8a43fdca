#include "decision_mpi.hpp"
#include "fragments.hpp"
#include "mpi/communicator.hpp"
#include "refinement_mpi.hpp"
#include "stage_scope.hpp"

#include <rrcb/balance.hpp>

#include <optional>

namespace rrcb {

namespace {

/// The options with nothing left to default, and every part with its size.
Options complete(Options options, int num_ranks) {
    if (options.num_parts == 0) options.num_parts = num_ranks;
    if (options.part_sizes.empty() && options.num_parts > 0)
        options.part_sizes.assign(static_cast<std::size_t>(options.num_parts), 1.0);
    if (options.refine == Refine::automatic)
        options.refine = options.domain == DomainKind::sampled ? Refine::none : Refine::tolerance;
    return options;
}

/// Assigns the points by the cuts as they are. Collective.
void assign_together(const Options& options, const Points& points, const SortedPoints& sorted,
                     MPI_Comm comm, Balance& result) {
    const StageScope stage(options.observer, Stage::assignment);
    const Failure failure = attempt([&] {
        if (options.domain == DomainKind::points) {
            assign(result.cuts, points, result.parts);
        } else {
            assign(result.cuts, sorted, result.parts);
        }
    });
    agree(failure, comm);
}

/// Moves the cuts by what the ranks count, and assigns the points by them. Collective.
void refine_together(Decision& decision, const Options& options, SortedPoints& sorted,
                     RefinementRoom& room, MPI_Comm comm, Balance& result) {
    const StageScope stage(options.observer, Stage::refinement);
    Report& report = result.report;
    if (report.all_weights_zero) sorted.weights.clear();
    const double weight =
        report.all_weights_zero ? static_cast<double>(report.num_points) : report.total_weight;
    Estimate estimate{std::move(result.cuts), std::move(decision.bisection.brackets), weight};
    const Measured measured = refine(estimate, options, sorted, room, comm, result.parts);
    report.measured_imbalance = measured.imbalance;
    report.rounds = measured.rounds;
    report.coincident_cuts = measured.coincident_cuts;
    result.cuts = std::move(estimate.cuts);
}

/// What all ranks hand to the root; the headers and records count there.
struct Gathered {
    std::vector<Header> headers;
    std::vector<double> records;
};

Gathered gather(const Contribution& mine, Failure& failure, const Options& options, MPI_Comm comm) {
    const StageScope stage(options.observer, Stage::gather);
    Gathered all;
    all.headers = gather_headers(mine.header, comm);
    agree(all.headers, failure, comm);
    all.records = gather_records(mine.records, all.headers, comm);
    return all;
}

/// The decision of the root, on every rank; throws what went wrong there on every rank.
Decision decide_together(const Gathered& all, int dimension, const Options& options,
                         const Cuts* previous, MPI_Comm comm) {
    Decision decision;
    Failure failure;
    if (mpi::rank_of(comm) == root) {
        const StageScope stage(options.observer, Stage::bisection);
        failure = decide(all.headers, all.records, options, previous, decision);
        if (failure.failed) decision.failing_rank = root;
    }
    const StageScope stage(options.observer, Stage::broadcast);
    broadcast(decision, dimension, options, comm);
    if (decision.failing_rank != no_rank) fail_together(decision.failing_rank, failure, comm);
    return decision;
}

Balance run(const Points& points, const Options& given, const Cuts* previous, MPI_Comm user) {
    const MPI_Comm comm = mpi::duplicate_of(user);
    Options options;
    Balance result;
    Contribution mine;
    std::optional<RefinementRoom> room;
    Failure failure = attempt([&] {
        const StageScope stage(given.observer, Stage::moments);
        options = complete(given, mpi::size_of(comm));
        if (previous) options.domain = DomainKind::analytic;
        const Box box = check_points(points);
        check_options(options, points.dimension);
        if (previous) check_previous(*previous, options, points.dimension);
        mine = contribute(points, box, options, previous, mpi::size_of(comm));
        result.parts.resize(points.count);
        if (is_refined(options))
            room.emplace(options, points.dimension, mpi::rank_of(comm) == root);
    });
    if (failure.failed) mine = {};
    mine.header.failed = failure.failed;
    const Gathered all = gather(mine, failure, options, comm);
    Decision decision = decide_together(all, points.dimension, options, previous, comm);
    result.report = decision.report;
    result.cuts = std::move(decision.bisection.cuts);
    if (is_refined(options) && decision.report.num_points > 0) {
        refine_together(decision, options, mine.points, *room, comm, result);
    } else {
        assign_together(options, points, mine.points, comm, result);
    }
    return result;
}

}  // namespace

Balance balance(const Points& points, const Options& options, MPI_Comm comm) {
    return run(points, options, nullptr, comm);
}

Balance balance(const Points& points, const Options& options, MPI_Comm comm, const Cuts& previous) {
    return run(points, options, &previous, comm);
}

}  // namespace rrcb
