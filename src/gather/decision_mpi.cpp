#include "gather/decision_mpi.hpp"

#include "bisection/bisection.hpp"
#include "bisection/domain_kinds.hpp"
#include "collective/communicator.hpp"
#include "cuts/tree.hpp"
#include "gather/keeping.hpp"

#include <rrcb/error.hpp>
#include <rrcb/quality.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace rrcb {

namespace {

/// Imbalance of a partition with the heaviest point alone in the largest part.
double least_imbalance(double heaviest, double weight, std::span<const double> part_sizes) {
    if (!(weight > 0)) return 1;
    const double sizes = std::accumulate(part_sizes.begin(), part_sizes.end(), 0.0);
    return std::max(1.0, heaviest / weight * (sizes / *std::ranges::max_element(part_sizes)));
}

double common_weight_of(const Summary& summary) {
    if (summary.weight == 0) return 1;
    return summary.lightest == summary.heaviest ? summary.heaviest : 0;
}

Verdict verdict_of(const Summary& summary, const Bisection& bisection,
                   std::span<const double> part_sizes) {
    Verdict verdict;
    verdict.common_weight = common_weight_of(summary);
    verdict.num_points = summary.num_points;
    verdict.num_records = summary.num_cells;
    verdict.total_weight = summary.weight;
    verdict.least_imbalance =
        summary.weight == 0
            ? least_imbalance(1, static_cast<double>(summary.num_points), part_sizes)
            : least_imbalance(summary.heaviest, summary.weight, part_sizes);
    verdict.estimated_imbalance =
        bisection.part_weights.empty() ? not_known : imbalance(bisection.part_weights, part_sizes);
    return verdict;
}

/// Throws Error when the ranks do not fit together.
void check_together(const Summary& summary) {
    if (summary.differing_rank != no_rank)
        throw Error(ErrorCode::invalid_argument,
                    std::string(name_of_request(summary.difference)) + " differs between rank " +
                        std::to_string(summary.reference_rank) + " and rank " +
                        std::to_string(summary.differing_rank) +
                        "; give the same value on every rank");
    if (!std::isfinite(summary.weight))
        throw Error(ErrorCode::invalid_argument,
                    "the sum of the weights of all ranks overflows; scale them down");
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

/// Makes earlier cuts such as the options ask for: planes, and nothing in parts of size 0.
void fit(const Options& options, Descent at, Cuts& cuts) {
    if (at.is_part()) return;
    Cut& cut = cuts.tree[at.node];
    const auto sizes = std::span(options.part_sizes)
                           .subspan(static_cast<std::size_t>(at.first_part),
                                    static_cast<std::size_t>(at.num_parts));
    const double share = share_below(sizes);
    const auto axis = static_cast<std::size_t>(cut.axis);
    double value = cut.at[axis];
    if (share <= 0) value = -std::numeric_limits<double>::infinity();
    if (share >= 1) value = std::numeric_limits<double>::infinity();
    if (options.plain_cuts || value != cut.at[axis]) {
        cut.divides = 0;
        cut.at.fill(-std::numeric_limits<double>::infinity());
    }
    cut.at[axis] = value;
    fit(options, at.lower(), cuts);
    fit(options, at.upper(), cuts);
}

Bisection reuse(const Cuts& previous, const Options& options, const Box& box, bool with_brackets) {
    Bisection bisection;
    bisection.cuts = previous;
    fit(options, root_of(previous), bisection.cuts);
    if (with_brackets && box.lower[0] <= box.upper[0])
        bracket_previous(bisection.cuts, root_of(previous), box, 0, bisection.brackets);
    return bisection;
}

/// Calls `visit` with each of the arrays that the message holds: of the current parts where they
/// stay, of the new cuts otherwise.
template <class Visit>
void for_each_array(Decision& decision, Visit&& visit) {
    const bool stays = decision.verdict.stays != 0;
    visit(std::span(stays ? decision.current.cuts.tree : decision.bisection.cuts.tree));
    if (stays) visit(std::span(decision.current.part_weights));
    if (stays) visit(std::span(decision.current.parts));
    if (!stays) visit(std::span(decision.bisection.brackets));
}

/// The message, as long as what it holds.
std::span<std::byte> message_of(Decision& decision) {
    std::size_t length = 0;
    for_each_array(decision, [&](auto array) { length += array.size_bytes(); });
    return std::span(decision.message).first(length);
}

void pack(Decision& decision) {
    auto to = decision.message.begin();
    for_each_array(decision,
                   [&](auto array) { to = std::ranges::copy(std::as_bytes(array), to).out; });
}

void unpack(Decision& decision) {
    auto from = std::as_const(decision.message).begin();
    for_each_array(decision, [&](auto array) {
        const std::span<std::byte> to = std::as_writable_bytes(array);
        std::copy_n(from, to.size(), to.begin());
        from += std::ssize(to);
    });
}

void broadcast_head(Head& head, Verdict& verdict, const Participant& self) {
    std::memcpy(head.data(), &verdict, sizeof verdict);
    mpi::broadcast(head, root, self.comm);
    std::memcpy(&verdict, head.data(), sizeof verdict);
    fail_together(verdict.failing_rank, self);
}

/// Reads the current parts from the places of all ranks, where these are one part each.
void weigh_current(const Contribution& all, const Options& options, Decision& decision) {
    const Cuts& estimate = decision.bisection.cuts;
    const std::vector<Place> places = read_places(all.places, estimate.dimension);
    if (places.empty() || places.size() != decision.current.parts.size()) return;
    if (all.summary.num_points == 0) return;
    auto current = read_current(places, estimate, options);
    if (!current) return;
    decision.verdict.current_imbalance = current->imbalance;
    decision.verdict.stays = stays_at_once(current->imbalance, options.imbalance_tolerance) ? 1 : 0;
    decision.current = std::move(*current);
}

}  // namespace

Report report_of(const Verdict& verdict, int num_parts) {
    Report report;
    report.num_points = verdict.num_points;
    report.num_records = verdict.num_records;
    report.total_weight = verdict.total_weight;
    report.estimated_imbalance = verdict.estimated_imbalance;
    report.measured_imbalance = not_known;
    report.least_imbalance = verdict.least_imbalance;
    report.all_weights_zero = verdict.num_points > 0 && verdict.total_weight == 0;
    report.surplus_parts =
        static_cast<int>(std::max(GlobalCount{0}, num_parts - verdict.num_points));
    return report;
}

bool is_refined(const Options& options) {
    return options.refine != Refine::none && options.cut_rule == CutRule::weighted_fraction &&
           !traits_of(options.domain).sends_points;
}

void make_room(Decision& decision, const Options& options, int dimension, bool may_stay) {
    const std::size_t num_parts = options.part_sizes.size();
    const std::size_t num_cuts = num_parts - 1;
    Bisection& bisection = decision.bisection;
    bisection.cuts.dimension = dimension;
    bisection.cuts.num_parts = static_cast<int>(num_parts);
    bisection.cuts.tree.resize(num_cuts);
    bisection.brackets.resize(is_refined(options) ? num_cuts : 0);
    if (may_stay) {
        decision.current.cuts = bisection.cuts;
        decision.current.part_weights.resize(num_parts);
        decision.current.parts.resize(num_parts);
    }
    const std::size_t beside_cuts =
        std::max(bisection.brackets.size() * sizeof(Bracket),
                 decision.current.parts.size() * (sizeof(double) + sizeof(Part)));
    decision.message.resize(num_cuts * sizeof(Cut) + beside_cuts);
}

void decide(const Contribution& all, const Options& options, const Cuts* previous,
            Decision& decision) {
    check_together(all.summary);
    const int dimension = decision.bisection.cuts.dimension;
    const bool with_brackets = is_refined(options);
    Bisection& bisection = decision.bisection;
    bisection = previous ? reuse(*previous, options, all.summary.box, with_brackets)
                         : bisect(build_domain(all, options, dimension), options, with_brackets);
    bisection.brackets.resize(with_brackets ? bisection.cuts.tree.size() : 0);
    decision.verdict = verdict_of(all.summary, bisection, options.part_sizes);
    weigh_current(all, options, decision);
}

void confirm(const Summary& all, Participant& self) {
    Verdict verdict;
    if (mpi::rank_of(self.comm) == root) {
        self.hear_of(all.failing_rank);
        self.attempt([&] { check_together(all); });
        verdict.failing_rank = self.failing_rank();
    }
    Head head{};
    broadcast_head(head, verdict, self);
}

void broadcast(Decision& decision, const Participant& self) {
    Head head{};
    const std::span<std::byte> space = std::span(head).subspan(sizeof(Verdict));
    const auto in_head = [&] {
        const std::span<std::byte> message = message_of(decision);
        return message.first(std::min(message.size(), space.size()));
    };
    if (mpi::rank_of(self.comm) == root && decision.verdict.failing_rank == no_rank) {
        pack(decision);
        std::ranges::copy(in_head(), space.begin());
    }
    broadcast_head(head, decision.verdict, self);
    // Now all know how long the message is.
    std::ranges::copy(space.first(in_head().size()), in_head().begin());
    mpi::broadcast(message_of(decision).subspan(in_head().size()), root, self.comm);
    unpack(decision);
}

void broadcast_current(Decision& decision, const Participant& self) {
    decision.verdict.stays = 1;
    if (mpi::rank_of(self.comm) == root) pack(decision);
    mpi::broadcast(message_of(decision), root, self.comm);
    unpack(decision);
}

}  // namespace rrcb
