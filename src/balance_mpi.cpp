#include "agreement_mpi.hpp"
#include "brackets.hpp"
#include "contribution.hpp"
#include "fragments.hpp"
#include "mpi/communicator.hpp"
#include "refinement_mpi.hpp"
#include "stage_scope.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/bisection.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <cstring>
#include <limits>

namespace rrcb {

namespace {

/// The literal midpoint has no weight to aim at, and all points at the root need no second look.
bool is_refined(const Options& options) {
    return options.refine != Refine::none && options.cut_rule == CutRule::weighted_fraction &&
           options.domain != DomainKind::points;
}

/// Records of all ranks at the root, in the order of the ranks; empty elsewhere. Collective.
std::vector<double> gather_records(std::span<const double> mine, std::span<const Header> headers,
                                   MPI_Comm comm) {
    std::vector<int> counts;
    std::vector<int> offsets;
    std::vector<double> records;
    if (mpi::rank_of(comm) == root) {
        std::int64_t offset = 0;
        for (const Header& header : headers) {
            offsets.push_back(mpi::to_int(offset));
            counts.push_back(mpi::to_int(header.num_records * header.record_length));
            offset += counts.back();
        }
        records.resize(static_cast<std::size_t>(offset));
    }
    mpi::check(
        MPI_Gatherv(mine.data(), mpi::to_int(static_cast<std::int64_t>(mine.size())), MPI_DOUBLE,
                    records.data(), counts.data(), offsets.data(), MPI_DOUBLE, root, comm),
        "MPI_Gatherv");
    return records;
}

/// The decision of the root: how it went, and the cuts to start from.
struct Decision {
    Verdict verdict;
    Report report;
    Bisection bisection;
};

Report report_of(std::span<const Header> headers, const Bisection& bisection,
                 std::span<const double> part_sizes) {
    Report report;
    for (const Header& header : headers) {
        report.num_points += header.num_points;
        report.num_records += header.num_records;
        report.total_weight += header.weight;
    }
    report.all_weights_zero = report.num_points > 0 && report.total_weight == 0;
    report.estimated_imbalance = imbalance(bisection.part_weights, part_sizes);
    report.measured_imbalance = std::numeric_limits<double>::quiet_NaN();
    report.surplus_parts =
        static_cast<int>(std::max(GlobalCount{0}, bisection.cuts.num_parts - report.num_points));
    return report;
}

Failure decide(std::span<const Header> headers, std::span<const double> records,
               const Options& options, Decision& decision) {
    return attempt([&] {
        decision.bisection = bisect(build_domain(headers, records, options), options.part_sizes,
                                    options.cut_rule, is_refined(options));
        decision.report = report_of(headers, decision.bisection, options.part_sizes);
    });
}

template <class T>
std::byte* copy_out(const T* from, std::size_t count, std::byte* to) {
    if (count > 0) std::memcpy(to, from, count * sizeof(T));
    return to + count * sizeof(T);
}

template <class T>
const std::byte* copy_in(const std::byte* from, T* to, std::size_t count) {
    if (count > 0) std::memcpy(to, from, count * sizeof(T));
    return from + count * sizeof(T);
}

/// Gives everybody the root's decision as one message. Collective.
void broadcast(Decision& decision, int dimension, const Options& options, MPI_Comm comm) {
    std::vector<Cut>& tree = decision.bisection.cuts.tree;
    std::vector<Bracket>& brackets = decision.bisection.brackets;
    tree.resize(options.part_sizes.size() - 1);
    brackets.resize(is_refined(options) ? tree.size() : 0);
    std::vector<std::byte> message(sizeof(Verdict) + sizeof(Report) + tree.size() * sizeof(Cut) +
                                   brackets.size() * sizeof(Bracket));
    std::byte* to = copy_out(&decision.verdict, 1, message.data());
    to = copy_out(&decision.report, 1, to);
    to = copy_out(tree.data(), tree.size(), to);
    copy_out(brackets.data(), brackets.size(), to);
    mpi::check(MPI_Bcast(message.data(), mpi::to_int(static_cast<std::int64_t>(message.size())),
                         MPI_BYTE, root, comm),
               "MPI_Bcast");
    const std::byte* from = copy_in(message.data(), &decision.verdict, 1);
    from = copy_in(from, &decision.report, 1);
    from = copy_in(from, tree.data(), tree.size());
    copy_in(from, brackets.data(), brackets.size());
    decision.bisection.cuts.dimension = dimension;
    decision.bisection.cuts.num_parts = static_cast<int>(options.part_sizes.size());
}

/// The options with nothing left to default, and every part with its size.
Options complete(Options options, int num_ranks) {
    if (options.num_parts == 0) options.num_parts = num_ranks;
    if (options.part_sizes.empty() && options.num_parts > 0)
        options.part_sizes.assign(static_cast<std::size_t>(options.num_parts), 1.0);
    if (options.refine == Refine::automatic)
        options.refine = options.domain == DomainKind::sampled ? Refine::none : Refine::tolerance;
    return options;
}

/// Assigns the points by the cuts, refined where that was asked for. Collective then.
void finish(Decision& decision, const Options& options, const Points& points, SortedPoints& sorted,
            MPI_Comm comm, Balance& result) {
    result.report = decision.report;
    result.cuts = std::move(decision.bisection.cuts);
    const bool refined = is_refined(options) && decision.report.num_points > 0;
    const StageScope stage(options.observer, refined ? Stage::refinement : Stage::assignment);
    if (options.domain == DomainKind::points) {
        assign(result.cuts, points, result.parts);
    } else if (!refined) {
        assign(result.cuts, sorted, result.parts);
    } else {
        if (decision.report.all_weights_zero) sorted.weights.clear();
        const double weight = decision.report.all_weights_zero
                                  ? static_cast<double>(decision.report.num_points)
                                  : decision.report.total_weight;
        Estimate estimate{std::move(result.cuts), std::move(decision.bisection.brackets),
                          options.part_sizes, weight};
        const Measured measured = refine(estimate, options, sorted, comm, result.parts);
        result.report.measured_imbalance = measured.imbalance;
        result.report.rounds = measured.rounds;
        result.cuts = std::move(estimate.cuts);
    }
}

}  // namespace

Balance balance(const Points& points, const Options& given, MPI_Comm user) {
    const MPI_Comm comm = mpi::duplicate_of(user);
    Options options;
    Balance result;
    Contribution mine;
    Failure failure = attempt([&] {
        const StageScope stage(given.observer, Stage::moments);
        options = complete(given, mpi::size_of(comm));
        check_points(points);
        check_options(options, points.dimension);
        mine = contribute(points, options);
        result.parts.resize(points.count);
    });
    if (failure.failed) mine = {};
    mine.header.failed = failure.failed ? 1 + static_cast<std::int32_t>(failure.code) : 0;
    std::vector<Header> headers;
    std::vector<double> records;
    {
        const StageScope stage(given.observer, Stage::gather);
        headers = gather_headers(mine.header, comm);
        agree(headers, failure, comm);
        records = gather_records(mine.records, headers, comm);
    }
    Decision decision;
    if (mpi::rank_of(comm) == root) {
        const StageScope stage(given.observer, Stage::bisection);
        failure = decide(headers, records, options, decision);
        if (failure.failed) decision.verdict = {root, static_cast<std::int32_t>(failure.code)};
    }
    {
        const StageScope stage(given.observer, Stage::broadcast);
        broadcast(decision, points.dimension, options, comm);
    }
    if (decision.verdict.failing_rank >= 0) fail_together(decision.verdict, failure, comm);

    finish(decision, options, points, mine.points, comm, result);
    return result;
}

}  // namespace rrcb
