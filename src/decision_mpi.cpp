#include "decision_mpi.hpp"

#include "brackets.hpp"
#include "descent.hpp"
#include "mpi/communicator.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace rrcb {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Of a partition with the heaviest point alone in the largest part.
double least_imbalance(double heaviest, double weight, std::span<const double> part_sizes) {
    if (!(weight > 0)) return 1;
    const double sizes = std::accumulate(part_sizes.begin(), part_sizes.end(), 0.0);
    return std::max(1.0, heaviest / weight * (sizes / *std::ranges::max_element(part_sizes)));
}

Report report_of(std::span<const Header> headers, const Bisection& bisection,
                 std::span<const double> part_sizes) {
    Report report;
    double heaviest = 0;
    for (const Header& header : headers) {
        heaviest = std::max(heaviest, header.heaviest);
        report.num_points += header.num_points;
        report.num_records += header.num_records;
        report.total_weight += header.weight;
    }
    report.all_weights_zero = report.num_points > 0 && report.total_weight == 0;
    report.least_imbalance =
        report.all_weights_zero
            ? least_imbalance(1, static_cast<double>(report.num_points), part_sizes)
            : least_imbalance(heaviest, report.total_weight, part_sizes);
    report.estimated_imbalance =
        bisection.part_weights.empty() ? not_known : imbalance(bisection.part_weights, part_sizes);
    report.measured_imbalance = not_known;
    report.surplus_parts =
        static_cast<int>(std::max(GlobalCount{0}, bisection.cuts.num_parts - report.num_points));
    return report;
}

/// Earlier cuts with brackets about them, as wide as estimated cuts of an even cloud would have.
void bracket_previous(const Cuts& cuts, Descent at, Box box, int depth,
                      std::vector<Bracket>& brackets) {
    if (at.is_part()) return;
    const Cut& cut = cuts.tree[at.node];
    const auto axis = static_cast<std::size_t>(cut.axis);
    const double value = std::clamp(cut.at[axis], box.lower[axis], box.upper[axis]);
    const double margin = expected_error(depth);
    brackets.push_back({std::lerp(value, box.lower[axis], 2 * margin),
                        std::nextafter(std::lerp(value, box.upper[axis], 2 * margin),
                                       std::numeric_limits<double>::infinity())});
    Box below = box;
    below.upper[axis] = value;
    bracket_previous(cuts, at.lower(), below, depth + 1, brackets);
    box.lower[axis] = value;
    bracket_previous(cuts, at.upper(), box, depth + 1, brackets);
}

Bisection reuse(const Cuts& previous, std::span<const Header> headers, bool with_brackets) {
    Bisection bisection;
    bisection.cuts = previous;
    Box box;
    for (const Header& header : headers) {
        for (std::size_t a = 0; a < max_dimension; ++a) {
            box.lower[a] = std::min(box.lower[a], header.box.lower[a]);
            box.upper[a] = std::max(box.upper[a], header.box.upper[a]);
        }
    }
    if (with_brackets && box.lower[0] <= box.upper[0])
        bracket_previous(previous, root_of(previous), box, 0, bisection.brackets);
    return bisection;
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

}  // namespace

bool is_refined(const Options& options) {
    return options.refine != Refine::none && options.cut_rule == CutRule::weighted_fraction &&
           options.domain != DomainKind::points;
}

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

Failure decide(std::span<const Header> headers, std::span<const double> records,
               const Options& options, const Cuts* previous, Decision& decision) {
    return attempt([&] {
        decision.bisection = previous ? reuse(*previous, headers, is_refined(options))
                                      : bisect(build_domain(headers, records, options), options,
                                               is_refined(options));
        decision.report = report_of(headers, decision.bisection, options.part_sizes);
    });
}

void broadcast(Decision& decision, int dimension, const Options& options, MPI_Comm comm) {
    std::vector<Cut>& tree = decision.bisection.cuts.tree;
    std::vector<Bracket>& brackets = decision.bisection.brackets;
    tree.resize(options.part_sizes.size() - 1);
    brackets.resize(is_refined(options) ? tree.size() : 0);
    std::vector<std::byte> message(sizeof(int) + sizeof(Report) + tree.size() * sizeof(Cut) +
                                   brackets.size() * sizeof(Bracket));
    std::byte* to = copy_out(&decision.failing_rank, 1, message.data());
    to = copy_out(&decision.report, 1, to);
    to = copy_out(tree.data(), tree.size(), to);
    copy_out(brackets.data(), brackets.size(), to);
    mpi::check(MPI_Bcast(message.data(), mpi::to_int(static_cast<std::int64_t>(message.size())),
                         MPI_BYTE, root, comm),
               "MPI_Bcast");
    const std::byte* from = copy_in(message.data(), &decision.failing_rank, 1);
    from = copy_in(from, &decision.report, 1);
    from = copy_in(from, tree.data(), tree.size());
    copy_in(from, brackets.data(), brackets.size());
    decision.bisection.cuts.dimension = dimension;
    decision.bisection.cuts.num_parts = static_cast<int>(options.part_sizes.size());
}

}  // namespace rrcb
