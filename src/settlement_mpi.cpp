#include "settlement_mpi.hpp"

#include "arithmetic/part_share.hpp"
#include "bisection/bisection.hpp"
#include "call_mpi.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "collective/stage_scope.hpp"
#include "options/allowed_axes.hpp"
#include "options/call_kind.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <functional>
#include <memory>

namespace rrcb {

double PartSums::add_up(std::span<const double> part_sizes, Participant& self) {
    const std::size_t num_parts = part_sizes.size();
    here_.back() = self.failed() ? 1 : 0;
    mpi::check(MPI_Reduce(here_.data(), sums_.data(), mpi::to_int(std::ssize(here_)), MPI_DOUBLE,
                          MPI_SUM, root, self.comm),
               "MPI_Reduce");
    if (mpi::rank_of(self.comm) == root) sums_.back() = imbalance(sums(), part_sizes);
    mpi::broadcast(std::as_writable_bytes(std::span(sums_)), root, self.comm);
    if (sums_[num_parts] > 0) fail_together(some_rank, self);
    return sums_.back();
}

std::vector<double> PartSums::take() {
    sums_.resize(sums_.size() - 2);
    return std::move(sums_);
}

namespace {

constexpr double round_off = 1e-12;  ///< of an imbalance

/// Returns the parts of a call; of the rule only what options choose.
PartTree tree_of(const Call& call) {
    const Options& options = call.options;
    const AxisOrder& order = options.axes.order;
    PartTree tree;
    tree.dimension = call.points.dimension();
    tree.num_parts = options.num_parts;
    tree.num_owners = call.is_spread ? call.ranks.number : 1;
    tree.shape = options.tree;
    tree.rule.part_sizes = options.part_sizes;
    if (order.is_given()) tree.cut_axes = order.axes();
    tree.axes = allowed_axes(order, call.points.dimension());
    tree.crosses_longest = order.is_longest();
    tree.rule.tolerance = options.imbalance_tolerance;
    tree.rule.is_exact = options.refine == Refine::exact;
    tree.plain_cuts = options.axes.plain;
    tree.centres_cuts = tree.rule.is_exact && !are_cuts_limited(options);
    tree.divides_coincident = options.coincident == Coincident::divide;
    tree.limits = axis_limits(options);
    return tree;
}

/// Flags of a rank: whether it still searches, and the imbalance of its parts so far.
Flags flags_of(const std::optional<TreeSearch>& search) {
    if (!search) return {};
    return {0, search->is_searching() ? 1.0 : 0.0, search->imbalance()};
}

}  // namespace

Refinement::Refinement(Call& call, const Participant& self)
    : call_(call),
      memory_(workspace_of(self.comm)),
      tree_(tree_of(call)),
      butterfly_(mpi::rank_of(self.comm), call.ranks.number, TreeSearch::join,
                 call.is_spread ? Butterfly::Way::spread : Butterfly::Way::central) {}

bool Refinement::is_earlier() const {
    return call_.decision.verdict.answer == Answer::weights;
}

/// Returns true if points and PartSums have the parts of earlier cuts.
bool Refinement::are_earlier_counted() const {
    return is_earlier() && !call_.decision.part_weights.empty();
}

void Refinement::run(Participant& self) {
    const double tolerance = call_.options.imbalance_tolerance;
    TargetRule& rule = tree_.rule;
    start(self);
    const bool are_accepted = accepts_cuts(self);
    // A search likely to miss the tolerance, and be repeated exactly, is exact at once.
    const bool may_miss = !call_.is_spread && !limits_ && !is_earlier() && !rule.is_attainable();
    rule.is_exact = rule.is_exact || (may_miss && !are_accepted);
    const bool is_searched = rule.is_exact || !are_accepted;
    if (is_searched && (limits_ || are_earlier_counted()))
        search_for_better(self);
    else if (is_searched)
        search_once(self);
    const bool is_good = imbalance_ <= tolerance && num_left_empty() == 0;
    const bool may_improve = is_searched || imbalance_ <= tolerance;
    if (!is_good && may_improve && !std::exchange(rule.is_exact, true)) search_for_better(self);
    Report& report = call_.result.report;
    if (report.details.num_points > 0) report_measured(imbalance_, tolerance, report);
    if (call_.is_spread) return agree(self);
    report.part_weights = call_.sums.take();
}

/// Derives the targets and the limits of the cuts from the decision.
void Refinement::start(Participant& self) {
    const Options& options = call_.options;
    const Verdict& verdict = call_.decision.verdict;
    const auto& sizes = options.part_sizes;
    const bool is_limited = are_cuts_limited(options);
    TargetRule& rule = tree_.rule;
    tree_.weight = verdict.balanced_weight();
    rule.common_weight = verdict.is_counted() ? 1 : 0;
    rule.heaviest = verdict.balanced_heaviest();
    rule.weight_per_size = tree_.weight / rule.size_of(root_of(options.num_parts, options.tree));
    if (call_.is_spread) return;
    // Kept parts would still be sent.
    if (!(verdict.kept_imbalance < not_kept)) call_.decision.message = std::vector<std::byte>();
    rule.is_earlier = is_earlier() && !is_limited;
    fills_parts_ = !is_limited && verdict.num_points >= std::ssize(sizes) &&
                   std::ranges::adjacent_find(sizes, std::not_equal_to<>()) == sizes.end();
    const Cuts& cuts = call_.result.cuts;
    if (is_limited)
        self.attempt(
            [&] { limits_.emplace(options, verdict.box, cuts.dimension, axes_of(cuts.tree)); });
    has_parts_ = are_earlier_counted();
    if (!has_parts_) return;
    call_.result.report.details.rounds = 1;
    imbalance_ = imbalance(call_.sums.sums(), sizes);
    rule.counted_weight = sum_of(call_.sums.sums());
}

/// Returns true if there is nothing to search: the cuts are good enough, or as even as any, or the
/// points are kept. Collective.
bool Refinement::accepts_cuts(Participant& self) {
    if (call_.is_spread) return false;
    if (has_parts_) return is_least();
    if (tree_.rule.is_exact && !limits_) return false;
    self.attempt([&] {
        const PartTotals totals = call_.points.assign(call_.result.cuts, true);
        std::ranges::copy(totals.weights, call_.sums.here().begin());
    });
    has_parts_ = true;
    measure(self);
    ++call_.result.report.details.rounds;
    const double tolerance = call_.options.imbalance_tolerance;
    return std::min(imbalance_, call_.decision.verdict.kept_imbalance) <= tolerance || is_least();
}

/// Returns true if no parts are more even.
bool Refinement::is_least() const {
    return imbalance_ <= call_.result.report.details.least_imbalance * (1 + round_off) &&
           num_left_empty() == 0;
}

/// Adds up the weights of the parts over all ranks. Collective; throws if one failed.
void Refinement::measure(Participant& self) {
    imbalance_ = call_.sums.add_up(call_.options.part_sizes, self);
    tree_.rule.counted_weight = sum_of(call_.sums.sums());
}

/// Returns the number of parts without weight although there are points for all; 0 if parts have
/// different sizes, because empty ones may be the most even then.
std::ptrdiff_t Refinement::num_left_empty() const {
    return fills_parts_ ? std::ranges::count(call_.sums.sums(), 0.0) : 0;
}

/// Finds all cuts, and the parts at the end. Collective.
void Refinement::search_once(Participant& self) {
    Cuts& cuts = call_.result.cuts;
    const bool has_parts = std::exchange(has_parts_, true);
    const bool is_counted = !tree_.rule.is_exact && !limits_;
    Guide guide{cuts,
                call_.decision.brackets,
                limits_ ? &*limits_ : nullptr,
                call_.sums.sums(),
                is_counted,
                call_.box};
    tree_.box = limits_ ? limits_->region() : call_.decision.verdict.box;
    const Cuts none{.dimension = tree_.dimension,
                    .num_parts = tree_.num_parts,
                    .tree = {},
                    .shape = tree_.shape};
    std::vector<Bracket> intervals;
    std::unique_ptr<OpenPoints> open;
    std::optional<TreeSearch> search;
    self.attempt([&] {
        if (call_.is_spread) {
            open = open_points(call_.points, none, {}, false, memory_.open);
        } else {
            intervals = likely_intervals(tree_.rule, guide);
            if (!limits_) guide.brackets = intervals;
            open = open_points(call_.points, cuts, intervals, has_parts, memory_.open);
        }
        search.emplace(tree_, butterfly_.rank(), *open, call_.is_spread ? nullptr : &guide);
    });
    ReportDetails& details = call_.result.report.details;
    details.rounds += run_rounds(search, self);
    const int num_coincident = search->num_coincident();
    details.coincident_cuts +=
        call_.is_spread ? mpi::sum_of(num_coincident, self.comm) : num_coincident;
    self.attempt([&] {
        std::ranges::copy(open->settle(), call_.sums.here().begin());
        if (call_.is_spread) cuts = search->own_cuts();
    });
    if (call_.is_spread)
        imbalance_ = butterfly_.flags()[2];
    else
        measure(self);
}

/// Ends a search, which this rank lacks if it has failed; returns the number of rounds.
///
/// Collective: each round is a pass to the owners and one back, and a spread search ends with one
/// to the owners. Throws on every rank the failure of one, before or here; a failure in the last
/// messages is held back until the next agreement.
int Refinement::run_rounds(std::optional<TreeSearch>& search, Participant& self) {
    const bool is_central = butterfly_.is_central();
    // Rank 0 of a central search knows all nodes, and sends with its answers whether any are left.
    const bool follows_first = is_central && butterfly_.rank() == root;
    // All ranks know the same flags after each round, and therefore agree on the next messages.
    for (int rounds = 0;; ++rounds) {
        butterfly_.clear();
        self.attempt([&] { search->ask(butterfly_); });
        messages_.run(butterfly_, Butterfly::to_owners, flags_of(search), self);
        if (!is_central && butterfly_.flags()[1] == 0) return rounds;
        self.attempt([&] { search->decide(butterfly_); });
        if (follows_first) self.attempt([&] { search->follow(butterfly_); });
        messages_.run(butterfly_, Butterfly::back, flags_of(search), self);
        if (!follows_first) self.attempt([&] { search->follow(butterfly_); });
        if (is_central && butterfly_.flags()[1] == 0) return rounds + 1;
    }
}

/// Searches all cuts, and keeps the new ones if they are better. Collective.
void Refinement::search_for_better(Participant& self) {
    Cuts& cuts = call_.result.cuts;
    int& coincident_cuts = call_.result.report.details.coincident_cuts;
    // Look-ups may not find the parts again.
    const bool keeps_parts = call_.is_spread || tree_.divides_coincident;
    Cuts cuts_before;
    std::vector<double> sums_before;
    std::vector<Part> parts_before;
    self.attempt([&] {
        const auto sums = call_.sums.sums();
        cuts_before = cuts;
        sums_before.assign(sums.begin(), sums.end());
        if (keeps_parts) parts_before = call_.points.parts();
    });
    const double imbalance_before = imbalance_;
    const int coincident_before = std::exchange(coincident_cuts, 0);
    const std::ptrdiff_t empty_before = num_left_empty();
    search_once(self);
    // Parts are filled only if they stay within the tolerance or as even as they were.
    const std::ptrdiff_t gain = empty_before - num_left_empty();
    const double tolerance = call_.options.imbalance_tolerance;
    const double most = gain > 0 ? std::max(imbalance_before, tolerance) : imbalance_before;
    const double margin = gain > 0 ? round_off : -round_off;
    if (imbalance_ < most * (1 + margin)) return;
    imbalance_ = imbalance_before;
    coincident_cuts = coincident_before;
    cuts = std::move(cuts_before);
    std::ranges::copy(sums_before, call_.sums.sums().begin());
    self.attempt([&] {
        if (keeps_parts) return call_.points.set_parts(parts_before);
        call_.points.assign(cuts, false);
    });
}

namespace {

/// Assigns the points by unchanged cuts; if `counts`, counts the parts. Collective.
void assign(Call& call, bool counts, Participant& self) {
    const StageScope stage(call.options.observer, Stage::assignment, self.arithmetic);
    self.attempt([&] {
        const PartTotals totals = call.points.assign(call.result.cuts, counts);
        if (counts) std::ranges::copy(totals.weights, call.sums.here().begin());
    });
    if (!counts) return agree(self);
    const double imbalance = call.sums.add_up(call.options.part_sizes, self);
    report_measured(imbalance, call.options.imbalance_tolerance, call.result.report);
    call.result.report.part_weights = call.sums.take();
}

}  // namespace

void prepare_to_settle(Call& call, bool counts, const Participant& self) {
    const bool is_searched = is_refined(call.options);
    if (is_searched || counts)
        call.sums = PartSums(call.is_spread ? 0 : call.options.part_sizes.size());
    if (is_searched) call.refinement.emplace(call, self);
}

void settle(Call& call, bool counts, Participant& self) {
    const bool has_points = call.result.report.details.num_points > 0;
    if (!call.is_spread && !(is_refined(call.options) && has_points))
        return assign(call, counts, self);
    const StageScope stage(call.options.observer, Stage::refinement, self.arithmetic);
    call.refinement->run(self);
}

}  // namespace rrcb
