#include "contribution.hpp"
#include "failure.hpp"
#include "fragments.hpp"
#include "mpi/communicator.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/bisection.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <cstring>
#include <numeric>

namespace rrcb {

namespace {

constexpr int root = 0;

/// What the root tells everybody: who failed, or how it went.
struct Verdict {
    std::int32_t failing_rank = -1;
    std::int32_t code = 0;
};

/// Text of `failure` on the failing rank, thrown on every rank. Collective.
[[noreturn]] void fail_together(const Verdict& verdict, const Failure& failure, MPI_Comm comm) {
    std::array<char, 512> text{};
    failure.text.copy(text.data(), text.size() - 1);
    mpi::check(
        MPI_Bcast(text.data(), static_cast<int>(text.size()), MPI_CHAR, verdict.failing_rank, comm),
        "MPI_Bcast");
    throw Error(static_cast<ErrorCode>(verdict.code),
                "rank " + std::to_string(verdict.failing_rank) + ": " + text.data());
}

/// The lowest failing rank, else what is wrong with the ranks together, as the root's failure.
Verdict judge(std::span<const Header> headers, Failure& failure) {
    for (std::size_t rank = 0; rank < headers.size(); ++rank)
        if (headers[rank].failed != 0)
            return {static_cast<std::int32_t>(rank), headers[rank].failed - 1};
    failure = attempt([&] {
        if (const auto difference = difference_between(headers))
            throw Error(ErrorCode::invalid_argument, *difference);
        std::int64_t length = 0;
        for (const Header& header : headers) length += header.num_records * header.record_length;
        mpi::to_int(length);
    });
    return failure.failed ? Verdict{root, static_cast<std::int32_t>(failure.code)} : Verdict{};
}

/// Headers of all ranks at the root; empty elsewhere. Collective.
std::vector<Header> gather_headers(const Header& mine, MPI_Comm comm) {
    const bool is_root = mpi::rank_of(comm) == root;
    std::vector<Header> headers(is_root ? static_cast<std::size_t>(mpi::size_of(comm)) : 0);
    mpi::check(MPI_Gather(&mine, sizeof(Header), MPI_BYTE, headers.data(), sizeof(Header), MPI_BYTE,
                          root, comm),
               "MPI_Gather");
    return headers;
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

/// The decision of the root as one message: verdict, report, cuts.
struct Decision {
    Verdict verdict;
    Report report;
    Cuts cuts;
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
    report.surplus_parts =
        static_cast<int>(std::max(GlobalCount{0}, bisection.cuts.num_parts - report.num_points));
    return report;
}

Failure decide(std::span<const Header> headers, std::span<const double> records,
               const Options& options, Decision& decision) {
    return attempt([&] {
        Bisection bisection = bisect(build_domain(headers, records, options), headers[0].num_parts,
                                     options.part_sizes, options.cut_rule);
        decision.report = report_of(headers, bisection, options.part_sizes);
        decision.cuts = std::move(bisection.cuts);
    });
}

/// Gives everybody the root's decision. Collective.
void broadcast(Decision& decision, int dimension, int num_parts, MPI_Comm comm) {
    struct Prefix {
        Verdict verdict;
        Report report;
    };
    const std::size_t tree_bytes = static_cast<std::size_t>(num_parts - 1) * sizeof(Cut);
    std::vector<std::byte> message(sizeof(Prefix) + tree_bytes);
    Prefix prefix{decision.verdict, decision.report};
    std::memcpy(message.data(), &prefix, sizeof prefix);
    std::memcpy(message.data() + sizeof prefix, decision.cuts.tree.data(),
                decision.cuts.tree.size() * sizeof(Cut));
    mpi::check(MPI_Bcast(message.data(), mpi::to_int(static_cast<std::int64_t>(message.size())),
                         MPI_BYTE, root, comm),
               "MPI_Bcast");
    std::memcpy(&prefix, message.data(), sizeof prefix);
    decision.verdict = prefix.verdict;
    decision.report = prefix.report;
    decision.cuts = {dimension, num_parts, {}};
    decision.cuts.tree.resize(static_cast<std::size_t>(num_parts - 1));
    std::memcpy(decision.cuts.tree.data(), message.data() + sizeof prefix, tree_bytes);
}

}  // namespace

Balance balance(const Points& points, const Options& options, MPI_Comm user) {
    const MPI_Comm comm = mpi::duplicate_of(user);
    const int num_parts = options.num_parts > 0 ? options.num_parts : mpi::size_of(comm);

    Balance result;
    Contribution mine;
    Failure failure = attempt([&] {
        check_points(points);
        check_options(options, points.dimension, num_parts);
        mine = contribute(points, options, num_parts);
        result.parts.resize(points.count);
    });
    if (failure.failed) mine = {};
    mine.header.failed = failure.failed ? 1 + static_cast<std::int32_t>(failure.code) : 0;

    const std::vector<Header> headers = gather_headers(mine.header, comm);
    const bool is_root = mpi::rank_of(comm) == root;
    Verdict verdict = is_root ? judge(headers, failure) : Verdict{};
    mpi::check(MPI_Bcast(&verdict, sizeof verdict, MPI_BYTE, root, comm), "MPI_Bcast");
    if (verdict.failing_rank >= 0) fail_together(verdict, failure, comm);

    const std::vector<double> records = gather_records(mine.records, headers, comm);
    Decision decision;
    if (is_root) {
        failure = decide(headers, records, options, decision);
        if (failure.failed) decision.verdict = {root, static_cast<std::int32_t>(failure.code)};
    }
    broadcast(decision, points.dimension, num_parts, comm);
    if (decision.verdict.failing_rank >= 0) fail_together(decision.verdict, failure, comm);

    if (options.domain == DomainKind::points) {
        assign(decision.cuts, points, result.parts);
    } else {
        assign(decision.cuts, mine.points, result.parts);
    }
    result.cuts = std::move(decision.cuts);
    result.report = decision.report;
    return result;
}

}  // namespace rrcb
