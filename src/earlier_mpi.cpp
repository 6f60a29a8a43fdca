#include "arithmetic/part_share.hpp"
#include "bisection/limited_bisection.hpp"
#include "call_mpi.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/stage_scope.hpp"
#include "cuts/cut_limits.hpp"
#include "cuts/owned_cuts.hpp"
#include "cuts/packed_tree.hpp"
#include "estimate/earlier_cuts.hpp"
#include "estimate/keeping_mpi.hpp"
#include "lists/tier_search_mpi.hpp"
#include "options/call_kind.hpp"
#include "passes/assignment.hpp"
#include "passes/host_passes.hpp"

#include <rrcb/plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace rrcb {

namespace {

void add(std::span<const double> a, std::span<const double> b, std::vector<double>& joined) {
    std::ranges::transform(a, b, std::back_inserter(joined), std::plus<>());
}

/// Reuse of earlier cuts, distributed or complete, in a call in which many ranks make the parts.
/// Memory is in proportion to the parts of a rank's points, and the cuts above them.
class SpreadReuse {
  public:
    /// Assigns the points by the cuts of the decision that this rank knows; `was_whole` if all
    /// ranks had all cuts. Borrows the call. Not collective; throws std::bad_alloc, and Error if
    /// the rank lacks a cut of its own.
    SpreadReuse(Call& call, bool was_whole, MPI_Comm comm)
        : call_(call),
          was_whole_(was_whole),
          totals_(call.host->assign_known(call.decision.cuts)),
          search_(PathSearch(call.decision.cuts, call.host->points(), call.host->parts_here()),
                  comm),
          sums_(mpi::rank_of(comm), mpi::size_of(comm), add) {}

    /// Finds the parts of all points and counts them. Returns false if they are not within the
    /// tolerance. Otherwise it completes the report, and stores the cuts above the points and parts
    /// of this rank.
    ///
    /// Collective: one pass through the ranks to find the parts, or more if one lacks cuts, one to
    /// add up and one to compare.
    bool ends(Participant& self) {
        Report& report = call_.result.report;
        search_together(search_, self);
        Cuts known = search_.search.take();
        self.attempt([&] { add_up(known.num_parts); });
        search_.messages.run(sums_, Butterfly::to_owners, {}, self);
        const double largest = largest_share(known.num_parts);
        sums_.clear();
        search_.messages.run(sums_, Butterfly::to_owners, {0, largest}, self);
        if (report.details.num_points > 0) {
            report_measured(sums_.flags()[1], call_.options.imbalance_tolerance, report);
            if (!report.within_tolerance) return false;
        }
        self.attempt([&] { call_.result.cuts = kept(std::move(known)); });
        agree(self);
        report.details.rounds = report.details.num_points > 0 ? 1 : 0;
        return true;
    }

  private:
    /// Adds up the parts found at once, and the parts of points searched one by one.
    void add_up(int num_parts) {
        const bool by_count = call_.decision.verdict.is_counted();
        const std::vector<double>& known = by_count ? totals_.counts : totals_.weights;
        for (std::size_t k = 0; k < known.size(); ++k)
            if (!is_unknown(totals_.parts[k]) && totals_.counts[k] > 0)
                weights_[totals_.parts[k]] += known[k];
        for (const LocalIndex i : search_.search.searched())
            weights_[call_.host->parts_here()[i]] += call_.host->points().weight(i);
        for (const auto& [part, weight] : weights_) {
            const RankRange ranks = ranks_of_part(part, num_parts, sums_.num_ranks());
            sums_.add(static_cast<Key>(part), ranks.first_rank, std::array{weight});
        }
    }

    /// Returns the largest weight over the ideal one of this rank's own parts.
    double largest_share(int num_parts) const {
        const std::vector<double>& sizes = call_.options.part_sizes;
        const double all_sizes = sizes.empty() ? num_parts : sum_of(sizes);
        double largest = 0;
        sums_.owned().for_each([&](const Record& part) {
            const double ideal = (sizes.empty() ? 1 : sizes[part.key]) / all_sizes;
            const double total = call_.decision.verdict.balanced_weight();
            largest = std::max(largest, over_ideal(part.payload[0], total, ideal));
        });
        return largest;
    }

    /// Returns all cuts if each rank has and gets them; otherwise those above the points and the
    /// parts of this rank.
    Cuts kept(Cuts&& known) const {
        Cuts kept{known.dimension, known.num_parts, {}, {}, known.shape};
        if (was_whole_ && call_.options.cuts == HeldCuts::whole) {
            kept.tree = std::move(known.tree);
            return kept;
        }
        std::vector<Part> needed;
        const auto [first, end] = parts_on(sums_.rank(), known.num_parts, sums_.num_ranks());
        for (Part part = first; part < end; ++part) needed.push_back(part);
        for (const auto& [part, weight] : weights_) needed.push_back(part);
        std::ranges::sort(needed);
        for (std::size_t k = 0; k < known.nodes.size(); ++k) {
            const Descent at = node_at(known, static_cast<std::size_t>(known.nodes[k]));
            const auto next = std::ranges::lower_bound(needed, at.first_part);
            if (next == needed.end() || *next >= at.first_part + at.num_parts) continue;
            kept.nodes.push_back(known.nodes[k]);
            kept.tree.push_back(known.tree[k]);
        }
        return kept;
    }

    Call& call_;
    bool was_whole_;
    KnownTotals totals_;  ///< of this rank
    SearchBuffers<PathSearch> search_;
    Butterfly sums_;
    std::map<Part, double> weights_{};  ///< of the points here, in each part
};

/// Returns true if the call may begin with earlier cuts.
bool may_reuse(const Cuts& previous, const Call& call) {
    if (!call.is_spread) return is_whole(previous);
    return call.options.refine != Refine::exact && !call.options.axes.order.is_given();
}

/// Prepares a call from earlier cuts: assigns the points by them, and counts the parts if they may
/// be kept; for `spread` if many ranks weigh them. Not collective.
void prepare_to_reuse(const Options& given, const Cuts& previous, Call& call,
                      std::optional<SpreadReuse>& spread, const Participant& self) {
    const StageScope stage(given.observer, Stage::assignment, self.arithmetic);
    PointPasses& points = call.points;
    points.use_weights(true);
    const PointSummary summary = points.summary(!counts_earlier_parts(given));
    call.box = summary.box;
    introduce(given, summary, &previous, call, self);
    if (!may_reuse(previous, call)) return;
    const Options& options = call.options;
    take_earlier(call.decision, options, call.is_spread, previous);
    const Cuts& cuts = call.decision.cuts;
    if (call.is_spread) {
        spread.emplace(call, is_whole(previous), self.comm);
        return;
    }
    PartTotals totals;
    if (counts_earlier_parts(options)) totals = points.assign(cuts, true);
    prepare_to_settle(call, are_cuts_limited(options), self);
    const double reach = cuts.near.reach;
    const PointSample sample =
        reach > 0 ? points.sample(sample_size(1 << 10, call.ranks.number)) : PointSample{};
    add_totals(totals, near_share(cuts, sample, reach), call.mine);
}

/// Returns true if the cuts whose parts rank 0 weighed are kept; completes the report then.
bool keeps_earlier(Call& call) {
    const Options& options = call.options;
    Report& report = call.result.report;
    if (report.details.num_points == 0) return true;
    if (are_cuts_limited(options)) return false;
    // An uncounted imbalance is NaN; > would raise a floating-point exception.
    if (is_refined(options) && !std::islessequal(report.imbalance, options.imbalance_tolerance))
        return false;
    report.details.rounds = is_refined(options) ? 1 : 0;
    report_measured(report.imbalance, options.imbalance_tolerance, report);
    report.part_weights = std::move(call.decision.part_weights);
    return true;
}

/// Moves the earlier cuts, first to allowed positions if there are limits. Collective.
void settle_from_earlier(Call& call, Participant& self) {
    const Options& options = call.options;
    Decision& decision = call.decision;
    if (counts_earlier_parts(options))
        self.attempt([&] { call.box = call.points.summary(true).box; });
    decision.verdict.box = box_together(call.box, self);
    const Box& whole = decision.verdict.box;
    if (are_cuts_limited(options))
        self.attempt([&] {
            CutLimits limits(options, whole, call.result.cuts.dimension);
            limits.require_room();
            move_into_places(limits, call.result.cuts);
        });
    if (is_refined(options) && counts_earlier_parts(options))
        std::ranges::copy(decision.part_weights, call.sums.sums().begin());
    if (is_refined(options)) bracket_earlier(call.result.cuts, whole, decision.brackets);
    settle(call, true, self);
}

bool are_same(const Cuts& a, const Cuts& b) {
    return std::ranges::equal(a.tree, b.tree, [](const Cut& one, const Cut& other) {
        return one.axis == other.axis && one.at == other.at;
    });
}

/// Makes cuts anew from samples only, and returns whether they save ghosts. Collective.
bool sample_saves_ghosts(const Cuts& reused, const PointSample& sample, PointPasses& points,
                         Options options, Participant& self) {
    const int dimension = points.dimension();
    std::vector<double> coordinates;
    std::vector<double> weights;
    self.attempt([&] {
        const std::size_t size = std::max<std::size_t>(1, sample.positions.size());
        const double scale = static_cast<double>(points.count()) / static_cast<double>(size);
        for (const Vector& x : sample.positions)
            coordinates.insert(coordinates.end(), x.begin(), x.begin() + dimension);
        weights.assign(sample.positions.size(), scale);
        for (std::size_t k = 0; k < sample.weights.size(); ++k) weights[k] *= sample.weights[k];
    });
    HostPasses some(interleaved_points(coordinates, dimension, weights), {});
    options.refine = Refine::none;
    const Balance anew = balance_from_scratch(some, options, false, self);
    return saves_ghosts(reused, anew.cuts, sample, points.count(), self);
}

}  // namespace

Balance balance_from_earlier(PointPasses& points, const Options& given, const Cuts& previous,
                             bool may_keep, Participant& self) {
    Call call(points, given.observer, self);
    std::optional<SpreadReuse> spread;
    self.attempt([&] { prepare_to_reuse(given, previous, call, spread, self); });
    // Both ways begin with the same messages, so a failed rank does not wait alone.
    if (!self.failed() && !may_reuse(previous, call))
        return balance_from_scratch(points, given, may_keep, self);
    estimate(call, self);
    if (spread) {
        if (!spread->ends(self)) return balance_from_scratch(points, given, may_keep, self);
        hold_cuts(call, self);
        complete(call);
        return std::move(call.result);
    }
    const bool is_kept = keeps_earlier(call);
    if (!is_kept) settle_from_earlier(call, self);
    self.attempt([&] { complete(call); });
    const Report& report = call.result.report;
    const double near_now = call.decision.verdict.near_per_cut;
    const bool may_save = may_save_ghosts(call.options, previous.near, near_now);
    const double chosen = may_save ? 0 : previous.near.share;
    const bool are_moved = !is_kept && !are_same(call.result.cuts, previous);
    call.result.cuts.near.share = reference(chosen, near_now, are_moved);
    const bool may_be_better =
        may_be_poor(report.imbalance, report.details.least_imbalance, call.options);
    if (!may_save && !may_be_better) return std::move(call.result);
    PointSample sample;
    if (may_save)
        self.attempt([&] { sample = points.sample(sample_size(1 << 13, call.ranks.number)); });
    if (!may_be_better && !sample_saves_ghosts(call.result.cuts, sample, points, given, self))
        return std::move(call.result);
    std::vector<Part> parts;
    self.attempt([&] { parts = points.parts(); });
    Balance anew = balance_from_scratch(points, given, false, self);
    if (may_save) self.attempt([&] { sample = points.sample(1 << 14); });
    return better(std::move(call.result), parts, std::move(anew), points, call.options,
                  may_save ? &sample : nullptr, self);
}

}  // namespace rrcb
