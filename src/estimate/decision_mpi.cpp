#include "estimate/decision_mpi.hpp"

#include "arithmetic/part_share.hpp"
#include "bisection/bisection.hpp"
#include "bisection/limited_bisection.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/meeting_mpi.hpp"
#include "cuts/tree.hpp"
#include "estimate/earlier_cuts.hpp"
#include "estimate/keeping_mpi.hpp"
#include "estimate/turning.hpp"
#include "options/axis_order.hpp"
#include "options/call_kind.hpp"
#include "options/rejection.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace rrcb {

namespace {

/// Returns the least possible imbalance of points of equal weight in parts of these relative sizes.
/// Each part first gets the whole number in its share; each remaining point goes to the part which
/// it makes least too heavy.
double least_imbalance_by_count(GlobalCount num_points, std::span<const double> part_sizes) {
    const double unit = static_cast<double>(num_points) / sum_of(part_sizes);
    using NextPoint = std::pair<double, double>;  // relative weight of a part with one more point,
                                                  // and its size
    std::priority_queue<NextPoint, std::vector<NextPoint>, std::greater<>> next;
    GlobalCount num_left = num_points;
    for (const double size : part_sizes) {
        const double count = std::floor(size * unit);
        num_left -= static_cast<GlobalCount>(count);
        if (size > 0) next.emplace((count + 1) / (size * unit), size);
    }
    double least = 1;
    for (; num_left > 0; --num_left) {
        const auto [relative, size] = next.top();
        next.pop();
        least = relative;
        next.emplace(relative + 1 / (size * unit), size);
    }
    return std::max(1.0, least);
}

/// Returns a lower bound of the imbalance of all partitions.
double least_imbalance(const Verdict& verdict, int num_parts, std::span<const double> part_sizes) {
    const GlobalCount count = verdict.num_points;
    if (count == 0) return 1;
    const bool is_even =
        part_sizes.empty() || std::ranges::min(part_sizes) == std::ranges::max(part_sizes);
    if (verdict.is_counted() && is_even)
        return static_cast<double>((count - 1) / num_parts + 1) * num_parts /
               static_cast<double>(count);
    if (verdict.is_counted()) return least_imbalance_by_count(count, part_sizes);
    const double parts = is_even ? num_parts : sum_of(part_sizes) / std::ranges::max(part_sizes);
    return std::max(1.0, verdict.balanced_heaviest() / verdict.balanced_weight() * parts);
}

/// Returns the arrays of a decision as bytes.
std::array<std::span<std::byte>, 6> arrays_of(Decision& decision) {
    const auto bytes = [](auto& array) { return std::as_writable_bytes(std::span(array)); };
    const Verdict& verdict = decision.verdict;
    if (verdict.answer == Answer::totals) return {};
    if (verdict.answer == Answer::weights) return {bytes(decision.part_weights)};
    const auto numbers =
        verdict.has_numbers != 0 ? bytes(decision.numbers) : std::span<std::byte>();
    if (verdict.answer == Answer::kept)
        return {bytes(decision.cuts.tree), bytes(decision.part_weights), bytes(decision.parts),
                numbers};
    std::array arrays{bytes(decision.cuts.tree),       bytes(decision.brackets),
                      bytes(decision.part_weights),    bytes(decision.turned.cuts.tree),
                      bytes(decision.turned.brackets), numbers};
    if (!(verdict.kept_imbalance < not_kept)) arrays[2] = {};
    if (verdict.may_turn == 0) arrays[3] = arrays[4] = {};
    return arrays;
}

std::size_t num_bytes(Decision& decision) {
    std::size_t length = sizeof(Verdict);
    for (const auto array : arrays_of(decision)) length += array.size();
    return length;
}

/// Writes the arrays into the message, after the verdict.
void pack(Decision& decision, std::span<std::byte> message) {
    auto to = message.begin() + sizeof(Verdict);
    for (const auto array : arrays_of(decision)) to = std::ranges::copy(array, to).out;
}

void unpack(Decision& decision, std::span<const std::byte> message) {
    std::size_t from = sizeof(Verdict);
    for (const auto array : arrays_of(decision)) {
        std::ranges::copy(message.subspan(from, array.size()), array.begin());
        from += array.size();
    }
}

/// Number of bytes of the first message from rank 0, for any options.
constexpr std::size_t head_length = 2048;

/// Allocates memory for a message with this many bytes of arrays.
void make_message(std::size_t arrays, Decision& decision) {
    decision.message.resize(std::max(head_length, sizeof(Verdict) + arrays));
}

/// Decides that the ranks keep their points.
void keep(Decision& decision) {
    decision.verdict.answer = Answer::kept;
    if (!decision.held) return;
    decision.cuts = std::move(decision.held->cuts);
    decision.part_weights = std::move(decision.held->part_weights);
    decision.parts = std::move(decision.held->parts);
}

/// Computes the imbalance of the parts of earlier cuts, whose points the ranks have counted. It is
/// infinite if the limits of cuts rule these cuts out.
void weigh_parts(const Contribution& all, const Options& options, Decision& decision) {
    if (all.summary.num_points == 0) return;
    const std::size_t num_parts = decision.part_weights.size();
    const std::size_t first = decision.verdict.is_counted() ? num_parts : 0;
    std::ranges::copy(std::span(all.part_totals).subspan(first, num_parts),
                      decision.part_weights.begin());
    const bool are_allowed =
        !are_cuts_limited(options) || are_in_places(all.summary.box, decision.cuts, options);
    decision.verdict.measured_imbalance =
        are_allowed ? imbalance(decision.part_weights, options.part_sizes) : not_kept;
}

/// Reads the parts that the ranks hold now from the extents of their points. Returns nullopt if
/// they are not a bisection into this number of parts, or if some rank holds no part.
std::optional<KeptTree> read_held(const Contribution& all, const Cuts& estimate,
                                  const Options& options) {
    std::vector<PointSummary> extents = read_extents(all.extents, estimate.dimension);
    if (extents.size() != static_cast<std::size_t>(options.num_parts)) return {};
    if (all.summary.num_points == 0) return {};
    if (Verdict{all.summary}.is_counted())
        for (PointSummary& extent : extents) extent.weight = static_cast<double>(extent.count);
    return read_kept_tree(extents, estimate, options);
}

/// Bisects the cells of all ranks, and reads the parts that the ranks hold now. If these are a
/// bisection, the returned cuts are across its axes; otherwise the cuts of resting points might
/// turn in every call. Cuts across other axes are put into `decision.turned` as alternative: always
/// if the present parts are uneven, otherwise only if they seem to be better. Points near both are
/// then counted, because the estimate itself depends on which ranks hold the points.
Bisection make_cuts(const Contribution& all, const Options& options, Decision& decision) {
    constexpr double enough = 0.85;
    const StatisticalDomain domain = build_domain(all, decision.cuts.dimension);
    const bool with_brackets = is_refined(options);
    const Cuts* earlier = decision.earlier;
    decision.numbers.clear();
    Bisection made = earlier ? bisect_along(domain, all, options, *earlier)
                             : bisect_gathered(domain, all, options, with_brackets);
    decision.held = read_held(all, made.cuts, options);
    if (!decision.held) return made;
    const std::vector<int> axes = axes_of(decision.held->cuts.tree);
    if (axes == axes_of(made.cuts.tree)) return made;
    if (earlier) {
        decision.held.reset();
        return made;
    }
    Options along = options;
    along.expert.axes.order = AxisOrder::given(axes);
    Bisection across = bisect_gathered(domain, all, along, with_brackets);
    const bool is_even = decision.held->imbalance <= options.imbalance_tolerance;
    if (is_longest(options.expert.axes.order) ||
        (is_even && are_axes_good(domain, decision.held->cuts, made.cuts, enough)))
        return across;
    decision.turned = std::move(made);
    return across;
}

}  // namespace

void check_together(const Summary& summary) {
    if (summary.differing_rank != no_rank)
        reject(difference(name_of_request(summary.difference), Shared{}.fix, summary.reference_rank,
                          summary.differing_rank));
    if (summary.weighted_rank != no_rank && summary.unweighted_rank != no_rank) {
        const Shared weights = weights_given({});
        reject(
            difference(weights.name, weights.fix, summary.weighted_rank, summary.unweighted_rank));
    }
    if (!std::isfinite(summary.weight))
        reject("the sum of the weights of all ranks overflows; scale them down");
}

Verdict verdict_of(const Summary& summary, std::span<const double> estimated,
                   std::span<const double> part_sizes) {
    Verdict verdict{summary};
    if (!estimated.empty() || summary.num_points == 0)
        verdict.estimated_imbalance = imbalance(estimated, part_sizes);
    return verdict;
}

Report report_of(const Verdict& verdict, int num_parts, std::span<const double> part_sizes) {
    Report report;
    report.details.num_points = verdict.num_points;
    report.details.num_cells = verdict.num_cells;
    report.details.total_weight = verdict.weight;
    report.details.estimated_imbalance = verdict.estimated_imbalance;
    report.imbalance = verdict.measured_imbalance;
    if (verdict.num_points == 0) report_measured(1, 1, report);
    report.details.all_weights_zero = verdict.num_points > 0 && verdict.weight == 0;
    report.details.least_imbalance = least_imbalance(verdict, num_parts, part_sizes);
    report.details.num_empty_parts =
        static_cast<int>(std::max(GlobalCount{0}, num_parts - verdict.num_points));
    return report;
}

void finish_weights(const Verdict& verdict, const Cuts& cuts, std::vector<double>& weights) {
    if (verdict.is_counted())
        for (double& weight : weights) weight *= verdict.unit();
    if (cuts.is_numbered_in_order()) return;
    const std::vector<double> of_ends = weights;
    for (std::size_t end = 0; end < of_ends.size(); ++end)
        weights[cuts.part_at(static_cast<Part>(end))] = of_ends[end];
}

void report_measured(double imbalance, double tolerance, Report& report) {
    report.imbalance = imbalance;
    report.within_tolerance = std::islessequal(imbalance, tolerance);
}

void take_earlier(Decision& decision, const Options& options, const Cuts& previous) {
    decision.verdict.answer = Answer::weights;
    decision.cuts = fitted(previous, options);
    decision.part_weights.resize(static_cast<std::size_t>(options.num_parts));
    make_message(std::span(decision.part_weights).size_bytes(), decision);
}

void make_buffers(Decision& decision, const Options& options, int dimension, bool may_keep) {
    const std::size_t num_parts = options.part_sizes.size();
    const std::size_t num_cuts = num_parts - 1;
    Cuts& cuts = decision.cuts;
    cuts = {dimension, static_cast<int>(num_parts), std::vector<Cut>(num_cuts),
            options.expert.tree};
    if (decision.earlier) {
        cuts.numbers = decision.earlier->numbers;
        decision.numbers.resize(num_parts);
    }
    decision.brackets.resize(is_refined(options) ? num_cuts : 0);
    if (may_keep) {
        decision.part_weights.resize(num_parts);
        decision.parts.resize(num_parts);
        decision.turned.cuts = cuts;
        decision.turned.brackets = decision.brackets;
    }
    const std::size_t of_cuts = num_cuts * sizeof(Cut) + decision.brackets.size() * sizeof(Bracket);
    make_message((may_keep ? 2 : 1) * of_cuts +
                     decision.parts.size() * (sizeof(double) + sizeof(Part)) +
                     decision.numbers.size() * sizeof(Part),
                 decision);
}

void decide(const Contribution& all, const Options& options, Decision& decision) {
    check_together(all.summary);
    const Answer answer = decision.verdict.answer;
    std::vector<double> estimated;
    if (answer == Answer::cuts) {
        const std::size_t num_brackets = decision.brackets.size();
        Bisection made = make_cuts(all, options, decision);
        if (decision.earlier && made.cuts.numbers != decision.earlier->numbers)
            decision.numbers = made.cuts.numbers;
        decision.cuts = std::move(made.cuts);
        decision.brackets = std::move(made.brackets);
        decision.brackets.resize(num_brackets);
        estimated = std::move(made.part_weights);
    }
    Verdict& verdict = decision.verdict;
    verdict = verdict_of(all.summary, estimated, options.part_sizes);
    verdict.answer = answer;
    verdict.debt = decision.cuts.debt;
    verdict.has_numbers = decision.numbers.empty() ? 0 : 1;
    if (answer == Answer::weights) weigh_parts(all, options, decision);
    if (!decision.held) return;
    verdict.kept_imbalance = decision.held->imbalance;
    decision.part_weights = decision.held->part_weights;
    const Bisection& turned = decision.turned;
    verdict.may_turn = turned.part_weights.empty() ? 0 : 1;
    if (verdict.may_turn == 0) {
        if (keeps_at_once(verdict.kept_imbalance, options)) keep(decision);
        return;
    }
    verdict.turned_imbalance = imbalance(turned.part_weights, options.part_sizes);
}

void broadcast(Decision& decision, Participant& self) {
    // A rank without memory for the message still receives its head, and throws afterwards.
    std::array<std::byte, head_length> spare{};
    Verdict& verdict = decision.verdict;
    std::span<std::byte> message = decision.message;
    if (message.empty()) message = spare;
    const std::span<std::byte> head = message.first(head_length);
    if (mpi::rank_of(self.comm) == root) {
        std::memcpy(head.data(), &verdict, sizeof verdict);
        if (verdict.failing_rank == no_rank) pack(decision, message);
    }
    broadcast_and_meet(head, self);
    std::memcpy(&verdict, head.data(), sizeof verdict);
    fail_together(verdict.failing_rank, self);
    // The head contains the length of the message, so all ranks know it now.
    const std::size_t length = std::max(head_length, num_bytes(decision));
    mpi::broadcast(message.first(length).subspan(head_length), root, self.comm);
    unpack(decision, message);
}

void broadcast_kept(Decision& decision, const Participant& self) {
    keep(decision);
    const auto message = std::span(decision.message).first(num_bytes(decision));
    if (mpi::rank_of(self.comm) == root) pack(decision, message);
    mpi::broadcast(message.subspan(sizeof(Verdict)), root, self.comm);
    unpack(decision, message);
}

}  // namespace rrcb
