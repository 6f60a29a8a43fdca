#include "search/settlement_mpi.hpp"

#include "arithmetic/part_share.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "options/allowed_axes.hpp"
#include "options/axis_order.hpp"
#include "options/call_kind.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

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

constexpr double round_off = 1e-12;  ///< relative rounding error of an imbalance

/// Returns the tree of parts of a call. Its rule contains only what follows from the options.
PartTree tree_of(const Options& options, int dimension, int num_ranks) {
    const AxisOrder& order = options.expert.axes.order;
    PartTree tree;
    tree.dimension = dimension;
    tree.num_parts = options.num_parts;
    tree.num_owners = is_spread(options, num_ranks) ? num_ranks : 1;
    tree.shape = options.expert.tree;
    tree.rule.part_sizes = options.part_sizes;
    if (is_given(order)) tree.cut_axes = axes_in(order);
    tree.axes = allowed_axes(order, dimension);
    tree.crosses_longest = is_longest(order);
    tree.rule.tolerance = options.imbalance_tolerance;
    tree.rule.is_exact = options.refine == Refine::exact;
    tree.plain_cuts = options.expert.axes.plain;
    tree.centres_cuts = tree.rule.is_exact && !are_cuts_limited(options);
    tree.divides_coincident = options.expert.coincident == Coincident::divide;
    tree.limits = axis_limits(options);
    return tree;
}

/// Returns the flags of a rank: whether it is still searching, and the imbalance of its parts so
/// far.
Flags flags_of(const std::optional<TreeSearch>& search) {
    if (!search) return {};
    return {0, search->is_searching() ? 1.0 : 0.0, search->imbalance()};
}

}  // namespace

Settlement::Settlement(const Options& options, PointPasses& points, bool counts, OpenMemory& memory,
                       const Participant& self)
    : options_(options),
      points_(points),
      is_spread_(is_spread(options, mpi::size_of(self.comm))),
      sums_((is_refined(options) || counts) && !is_spread_ ? options.part_sizes.size() : 0),
      memory_(memory),
      tree_(tree_of(options, points.dimension(), mpi::size_of(self.comm))),
      butterfly_(mpi::rank_of(self.comm), mpi::size_of(self.comm), TreeSearch::join,
                 is_spread_ ? Butterfly::Way::spread : Butterfly::Way::central) {}

SettledCuts Settlement::run(const AllPoints& all, const Box& here, bool counts, SettledCuts&& start,
                            Participant& self) {
    all_ = all;
    here_ = here;
    made_ = std::move(start);
    if (is_spread_ || (is_refined(options_) && all.number > 0)) {
        refine(self);
    } else {
        assign(counts, self);
    }
    if (!is_spread_ && (counts || has_parts_) && all.number > 0) made_.part_weights = sums_.take();
    if (all.number == 0) made_.imbalance = 1;
    return std::move(made_);
}

/// Assigns the points by unchanged cuts. If `counts`, also adds up the weights of the parts.
/// Collective.
void Settlement::assign(bool counts, Participant& self) {
    self.attempt([&] {
        const PartTotals totals = points_.assign(made_.cuts, counts);
        if (counts) std::ranges::copy(totals.weights, sums_.here().begin());
    });
    if (!counts) return agree(self);
    measure(self);
}

/// Searches for cuts that make the parts as even as requested. Collective.
void Settlement::refine(Participant& self) {
    const double tolerance = options_.imbalance_tolerance;
    TargetRule& rule = tree_.rule;
    start(self);
    const bool are_accepted = accepts_cuts(self);
    // If one point too many may exceed the tolerance, the search would probably have to be repeated
    // with exact cuts. Exact cuts are then searched at once.
    const bool may_miss = !is_spread_ && !limits_ && !rule.is_attainable();
    rule.is_exact = rule.is_exact || (may_miss && !are_accepted);
    const bool is_searched = rule.is_exact || !are_accepted;
    if (is_searched && limits_)
        search_for_better(self);
    else if (is_searched)
        search_once(self);
    const bool is_good = made_.imbalance <= tolerance && num_left_empty() == 0;
    const bool may_improve = is_searched || made_.imbalance <= tolerance;
    if (!is_good && may_improve && !std::exchange(rule.is_exact, true)) search_for_better(self);
    if (is_spread_) agree(self);
}

/// Computes the weight per part, and the limits of the cuts. Not collective.
void Settlement::start(Participant& self) {
    const auto& sizes = options_.part_sizes;
    const bool is_limited = are_cuts_limited(options_);
    TargetRule& rule = tree_.rule;
    tree_.weight = all_.weight;
    rule.common_weight = all_.are_counted ? 1 : 0;
    rule.heaviest = all_.heaviest;
    rule.weight_per_size =
        tree_.weight / rule.size_of(root_of(options_.num_parts, options_.expert.tree));
    made_.imbalance = 1;
    if (is_spread_) return;
    fills_parts_ = !is_limited && all_.number >= std::ssize(sizes) &&
                   std::ranges::adjacent_find(sizes, std::not_equal_to<>()) == sizes.end();
    const Cuts& cuts = made_.cuts;
    if (is_limited)
        self.attempt(
            [&] { limits_.emplace(options_, all_.box, cuts.dimension, axes_of(cuts.tree)); });
}

/// Returns true if no search is needed: the cuts are good enough, or no parts can be more even, or
/// the points are to be kept. Collective.
bool Settlement::accepts_cuts(Participant& self) {
    if (is_spread_ || (tree_.rule.is_exact && !limits_)) return false;
    assign(true, self);
    has_parts_ = true;
    ++made_.rounds;
    return std::min(made_.imbalance, all_.enough) <= options_.imbalance_tolerance || is_least();
}

/// Returns true if no other parts can be more even.
bool Settlement::is_least() {
    return made_.imbalance <= all_.least_imbalance * (1 + round_off) && num_left_empty() == 0;
}

/// Adds up the weights of the parts over all ranks. Collective; throws if a rank has failed.
void Settlement::measure(Participant& self) {
    made_.imbalance = sums_.add_up(options_.part_sizes, self);
    tree_.rule.counted_weight = sum_of(sums_.sums());
}

/// Returns the number of parts without weight if there are enough points for all parts. Returns 0
/// if parts have different sizes, because leaving some empty may then be the most even partition.
std::ptrdiff_t Settlement::num_left_empty() {
    return fills_parts_ ? std::ranges::count(sums_.sums(), 0.0) : 0;
}

/// Searches all cuts once and assigns the points to the parts. Collective.
void Settlement::search_once(Participant& self) {
    const bool has_parts = std::exchange(has_parts_, true);
    const bool is_counted = !tree_.rule.is_exact && !limits_;
    Guide guide{made_.cuts,   made_.brackets, limits_ ? &*limits_ : nullptr,
                sums_.sums(), is_counted,     here_};
    tree_.box = limits_ ? limits_->region() : all_.box;
    const Cuts none{.dimension = tree_.dimension,
                    .num_parts = tree_.num_parts,
                    .tree = {},
                    .shape = tree_.shape};
    const Guide* const known = is_spread_ ? nullptr : &guide;
    std::vector<Bracket> intervals;
    std::unique_ptr<OpenPoints> open;
    std::optional<TreeSearch> search;
    self.attempt([&] {
        if (known) {
            intervals = likely_intervals(tree_.rule, guide);
            if (!limits_) guide.brackets = intervals;
        }
        open = open_points(points_, known ? made_.cuts : none, intervals, has_parts, memory_);
        search.emplace(tree_, butterfly_.rank(), *open, known);
    });
    made_.rounds += run_rounds(search, self);
    const int num_coincident = search->num_coincident();
    made_.coincident_cuts += known ? num_coincident : mpi::sum_of(num_coincident, self.comm);
    std::vector<double> weights;
    self.attempt([&] {
        weights = open->settle();
        if (!known) made_.cuts = search->own_cuts(std::move(made_.cuts.numbers));
    });
    if (known) {
        std::ranges::copy(weights, sums_.here().begin());
        return measure(self);
    }
    made_.part_weights = std::move(weights);
    made_.imbalance = butterfly_.flags()[2];
}

/// Runs a search to its end. `search` is empty if this rank has failed. Returns the number of
/// rounds.
///
/// Collective: each round is a pass to the owners and a pass back; a search with several owners
/// ends with one more pass to the owners. If a rank has failed before or fails here, every rank
/// throws its failure; a failure in the last messages is held back until the next agreement.
int Settlement::run_rounds(std::optional<TreeSearch>& search, Participant& self) {
    const bool has_one_owner = tree_.num_owners == 1;
    // In a central search rank 0 has all nodes. It follows its own decisions first, so that its
    // answers also contain whether the search continues.
    const bool follows_first = has_one_owner && butterfly_.rank() == root;
    // After each round all ranks have the same flags, and therefore agree on whether more messages
    // follow.
    for (int rounds = 0;; ++rounds) {
        butterfly_.clear();
        self.attempt([&] { search->ask(butterfly_); });
        messages_.run(butterfly_, Butterfly::to_owners, flags_of(search), self);
        if (!has_one_owner && butterfly_.flags()[1] == 0) return rounds;
        self.attempt([&] { search->decide(butterfly_); });
        if (follows_first) self.attempt([&] { search->follow(butterfly_); });
        messages_.run(butterfly_, Butterfly::back, flags_of(search), self);
        if (!follows_first) self.attempt([&] { search->follow(butterfly_); });
        if (has_one_owner && butterfly_.flags()[1] == 0) return rounds + 1;
    }
}

/// Searches all cuts once more, and keeps the result only if it is better. Collective.
void Settlement::search_for_better(Participant& self) {
    // If the new cuts are worse, the earlier parts are restored. They must be kept for this if
    // coincident points were divided or many ranks made the cuts, because a look-up by the earlier
    // cuts would not give the same parts.
    const bool keeps_parts = is_spread_ || tree_.divides_coincident;
    Cuts cuts_before;
    std::vector<double> sums_before;
    std::vector<double> here_before;
    std::vector<Part> parts_before;
    self.attempt([&] {
        const auto sums = sums_.sums();
        cuts_before = made_.cuts;
        here_before = made_.part_weights;
        sums_before.assign(sums.begin(), sums.end());
        if (keeps_parts) parts_before = points_.parts();
    });
    const double imbalance_before = made_.imbalance;
    const int coincident_before = std::exchange(made_.coincident_cuts, 0);
    const std::ptrdiff_t empty_before = num_left_empty();
    search_once(self);
    // Fewer empty parts are a gain only if the imbalance is within the tolerance, or not above the
    // earlier one.
    const std::ptrdiff_t gain = empty_before - num_left_empty();
    const double tolerance = options_.imbalance_tolerance;
    const double most = gain > 0 ? std::max(imbalance_before, tolerance) : imbalance_before;
    const double margin = gain > 0 ? round_off : -round_off;
    if (made_.imbalance < most * (1 + margin)) return;
    made_.imbalance = imbalance_before;
    made_.coincident_cuts = coincident_before;
    made_.cuts = std::move(cuts_before);
    made_.part_weights = std::move(here_before);
    std::ranges::copy(sums_before, sums_.sums().begin());
    self.attempt([&] {
        if (keeps_parts) return points_.set_parts(parts_before);
        points_.assign(made_.cuts, false);
    });
}

}  // namespace rrcb
