#include "search/refinement_mpi.hpp"

#include "arithmetic/part_share.hpp"
#include "bisection/bisection.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "options/call_kind.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <functional>
#include <utility>

namespace rrcb {

namespace {

constexpr double round_off = 1e-12;  ///< of an imbalance

/// Flags of a rank: whether it still searches, and the imbalance of its parts so far.
Flags flags_of(const std::optional<TreeSearch>& search) {
    if (!search) return {};
    return {0, search->is_searching() ? 1.0 : 0.0, search->imbalance()};
}

}  // namespace

int TreeRounds::run(std::optional<TreeSearch>& search, Participant& self) {
    const bool is_central = butterfly_.is_central();
    // Rank 0 of a central search knows all nodes, and sends with its answers whether any are left.
    const bool follows_first = is_central && rank() == root;
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

Refinement::Refinement(const Options& options, const Participant& self, PartSums& sums)
    : options_(options),
      sums_(sums),
      memory_(workspace_of(self.comm)),
      tree_(tree_of(options, mpi::size_of(self.comm))),
      rounds_(mpi::rank_of(self.comm), mpi::size_of(self.comm), Butterfly::Way::central) {}

Refined Refinement::refine(Estimate&& estimate, PointPasses& points, const Box& box,
                           Participant& self) {
    box_ = box;
    start(std::move(estimate), self);
    const bool is_exact = tree_.rule.is_exact;
    const bool is_known = estimate_.is_counted || (is_exact && !are_cuts_limited(options_));
    has_parts_ = estimate_.is_counted || !is_known;
    const bool may_return = estimate_.is_earlier && estimate_.is_counted && !is_exact && !limits_;
    const bool is_accepted = is_known ? may_return && is_least() : accept_estimate(points, self);
    // A search that would miss the tolerance, and be repeated exactly, is exact at once.
    const bool may_miss = !tree_.rule.is_attainable() && !limits_ && !estimate_.is_earlier;
    tree_.rule.is_exact = is_exact || (may_miss && !is_accepted);
    const bool is_searched = tree_.rule.is_exact || !is_accepted;
    const bool has_parts_to_keep = limits_ || may_return;
    if (is_searched && has_parts_to_keep) search_for_better(points, self);
    if (is_searched && !has_parts_to_keep) search_once(points, self);
    if (is_searched || refined_.imbalance <= options_.imbalance_tolerance)
        search_exactly(points, self);
    refined_.cuts = std::move(estimate_.cuts);
    return std::move(refined_);
}

/// Searches exactly, once, if the cuts miss the tolerance or leave parts empty. Collective.
void Refinement::search_exactly(PointPasses& points, Participant& self) {
    const bool is_good =
        refined_.imbalance <= options_.imbalance_tolerance && num_left_empty() == 0;
    if (is_good || std::exchange(tree_.rule.is_exact, true)) return;
    search_for_better(points, self);
}

/// Takes an estimate, and derives the targets and the limits of its cuts.
void Refinement::start(Estimate&& estimate, Participant& self) {
    const auto& sizes = options_.part_sizes;
    const bool is_limited = are_cuts_limited(options_);
    estimate_ = std::move(estimate);
    tree_.weight = estimate_.total_weight;
    tree_.rule = {sizes,
                  options_.imbalance_tolerance,
                  estimate_.common_weight,
                  estimate_.heaviest,
                  estimate_.total_weight / sum_of(sizes),
                  0,
                  options_.refine == Refine::exact,
                  estimate_.is_earlier && !is_limited};
    fills_parts_ = !is_limited && estimate_.num_points >= std::ssize(sizes) &&
                   std::ranges::adjacent_find(sizes, std::not_equal_to<>()) == sizes.end();
    if (is_limited)
        self.attempt([&] {
            limits_.emplace(options_, estimate_.box, estimate_.cuts.dimension,
                            axes_of(estimate_.cuts.tree));
        });
    if (estimate_.is_counted) {
        refined_.rounds = 1;
        refined_.imbalance = imbalance(sums_.sums(), sizes);
        tree_.rule.counted_weight = sum_of(sums_.sums());
    }
}

/// Returns true if there is nothing to search: the estimated cuts are good enough, or as even as
/// any, or the points are kept. Then `parts` is complete. Collective.
bool Refinement::accept_estimate(PointPasses& points, Participant& self) {
    self.attempt([&] {
        const PartTotals totals = points.assign(estimate_.cuts, true);
        std::ranges::copy(totals.weights, sums_.here().begin());
    });
    measure(self);
    ++refined_.rounds;
    const double tolerance = options_.imbalance_tolerance;
    return refined_.imbalance <= tolerance || estimate_.kept_imbalance <= tolerance || is_least();
}

/// Returns true if no parts are more even.
bool Refinement::is_least() const {
    return refined_.imbalance <= estimate_.least_imbalance * (1 + round_off) &&
           num_left_empty() == 0;
}

/// Adds up the weights of the parts over all ranks. Collective; throws if one failed.
void Refinement::measure(Participant& self) {
    refined_.imbalance = sums_.add_up(options_.part_sizes, self);
    tree_.rule.counted_weight = sum_of(sums_.sums());
}

/// Returns the number of parts without weight although there are points for all; 0 if parts have
/// different sizes, because empty ones may be the most even then.
std::ptrdiff_t Refinement::num_left_empty() const {
    return fills_parts_ ? std::ranges::count(sums_.sums(), 0.0) : 0;
}

/// Finds all cuts, and the parts at the end. Collective.
void Refinement::search_once(PointPasses& points, Participant& self) {
    const bool is_counted = !tree_.rule.is_exact && !limits_;
    const Guide guide{estimate_.cuts,
                      estimate_.brackets,
                      limits_ ? &*limits_ : nullptr,
                      sums_,
                      is_counted,
                      std::exchange(has_parts_, true),
                      box_};
    std::optional<TreeSearch> search;
    self.attempt([&] {
        search.emplace(tree_, rounds_.rank(), guide, points, std::move(memory_.collected));
    });
    refined_.rounds += rounds_.run(search, self);
    refined_.coincident_cuts += search->num_coincident();
    self.attempt([&] { search->finish(); });
    memory_.collected = search->take_memory();
    measure(self);
}

/// Searches all cuts, and keeps the new ones if they are better. Collective.
void Refinement::search_for_better(PointPasses& points, Participant& self) {
    struct {
        std::vector<Cut> tree;
        std::vector<double> sums;
        std::vector<Part> parts;  ///< if look-ups may not find them
        int coincident_cuts = 0;
    } before;
    self.attempt([&] {
        const auto sums = sums_.sums();
        before = {estimate_.cuts.tree,
                  {sums.begin(), sums.end()},
                  tree_.divides_coincident ? points.parts() : std::vector<Part>(),
                  std::exchange(refined_.coincident_cuts, 0)};
    });
    const double imbalance_before = refined_.imbalance;
    const std::ptrdiff_t empty_before = num_left_empty();
    search_once(points, self);
    // Parts are filled only if they stay within the tolerance or as even as they were.
    const std::ptrdiff_t gain = empty_before - num_left_empty();
    const double most =
        gain > 0 ? std::max(imbalance_before, options_.imbalance_tolerance) : imbalance_before;
    const double margin = gain > 0 ? round_off : -round_off;
    if (refined_.imbalance < most * (1 + margin)) return;
    refined_.imbalance = imbalance_before;
    refined_.coincident_cuts = before.coincident_cuts;
    estimate_.cuts.tree = std::move(before.tree);
    std::ranges::copy(before.sums, sums_.sums().begin());
    self.attempt([&] {
        if (tree_.divides_coincident) return points.set_parts(before.parts);
        points.assign(estimate_.cuts, false);
    });
}

PartTree tree_of(const Options& options, int num_ranks) {
    PartTree tree;
    tree.num_parts = options.num_parts;
    tree.num_ranks = num_ranks;
    tree.shape = options.tree;
    tree.rule.part_sizes = options.part_sizes;
    if (options.axes.order.is_given()) tree.cut_axes = options.axes.order.axes();
    if (options.axes.order.is_among()) tree.axes = options.axes.order.axes();
    tree.crosses_longest = options.axes.order.is_longest();
    tree.rule.tolerance = options.imbalance_tolerance;
    tree.rule.is_exact = options.refine == Refine::exact;
    tree.plain_cuts = options.axes.plain;
    tree.centres_cuts = tree.rule.is_exact && !are_cuts_limited(options);
    tree.divides_coincident = options.coincident == Coincident::divide;
    tree.limits = axis_limits(options);
    return tree;
}

SpreadRefinement::SpreadRefinement(const Participant& self)
    : memory_(workspace_of(self.comm)),
      rounds_(mpi::rank_of(self.comm), mpi::size_of(self.comm), Butterfly::Way::spread) {}

Refined SpreadRefinement::refine(const Box& box, PartTree tree, HostPasses& points,
                                 Participant& self) {
    Refined refined = search(box, tree, points, self);
    const bool missed = refined.imbalance > tree.rule.tolerance;
    if (!missed || std::exchange(tree.rule.is_exact, true)) return refined;
    std::vector<Part> before;
    self.attempt([&] { before = points.parts(); });
    Refined exact = search(box, tree, points, self);
    exact.rounds += refined.rounds;
    if (exact.imbalance < refined.imbalance) return exact;
    refined.rounds = exact.rounds;
    points.set_parts(before);
    return refined;
}

/// Runs one search. Collective.
Refined SpreadRefinement::search(const Box& box, const PartTree& tree, HostPasses& points,
                                 Participant& self) {
    std::optional<TreeSearch> search;
    self.attempt([&] {
        points.collect_all(memory_.collected);
        search.emplace(tree, rounds_.rank(), box, points, std::move(memory_.collected));
    });
    Refined refined;
    refined.rounds = rounds_.run(search, self);
    refined.imbalance = rounds_.imbalance();
    refined.coincident_cuts = mpi::sum_of(search->num_coincident(), self.comm);
    self.attempt([&] {
        search->finish();
        refined.cuts = search->cuts();
    });
    memory_.collected = search->take_memory();
    return refined;
}

}  // namespace rrcb
