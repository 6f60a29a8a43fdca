#include "spread_reuse_mpi.hpp"

#include "arithmetic/part_share.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "cuts/owned_cuts.hpp"
#include "cuts/packed_tree.hpp"
#include "estimate/decision_mpi.hpp"

#include <rrcb/plan.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <utility>

namespace rrcb {

namespace {

void add(std::span<const double> a, std::span<const double> b, std::vector<double>& joined) {
    std::ranges::transform(a, b, std::back_inserter(joined), std::plus<>());
}

}  // namespace

SpreadReuse::SpreadReuse(const Cuts& cuts, const KnownTotals& totals, bool was_whole,
                         const Options& options, const Points& points, std::span<Part> parts,
                         MPI_Comm comm)
    : options_(options),
      points_(points),
      parts_(parts),
      totals_(totals),
      was_whole_(was_whole),
      buffers_(PathSearch(cuts, points, parts), comm),
      sums_(mpi::rank_of(comm), mpi::size_of(comm), add) {}

/// Adds up the parts found at once, and those of points that were searched one by one.
void SpreadReuse::add_up(bool by_count) {
    const std::vector<double>& known = by_count ? totals_.counts : totals_.weights;
    for (std::size_t k = 0; k < known.size(); ++k)
        if (!is_unknown(totals_.parts[k]) && totals_.counts[k] > 0)
            weights_[totals_.parts[k]] += known[k];
    for (const LocalIndex i : buffers_.search.searched())
        weights_[parts_[i]] += by_count ? 1 : points_.weight(i);
    for (const auto& [part, weight] : weights_) {
        const RankRange ranks = ranks_of_part(part, cuts_.num_parts, sums_.num_ranks());
        sums_.add(static_cast<Key>(part), ranks.first_rank, std::array{weight});
    }
}

/// Returns the largest weight of a part that this rank owns over its ideal weight.
double SpreadReuse::largest_share(double total_weight) const {
    const std::vector<double>& sizes = options_.part_sizes;
    const double all_sizes = sizes.empty() ? cuts_.num_parts : sum_of(sizes);
    double largest = 0;
    sums_.owned().for_each([&](const Record& part) {
        const double ideal = (sizes.empty() ? 1 : sizes[part.key]) / all_sizes;
        largest = std::max(largest, over_ideal(part.payload[0], total_weight, ideal));
    });
    return largest;
}

/// Returns the imbalance of the parts, the same on every rank. Collective.
double SpreadReuse::measure(double total_weight, bool by_count, Participant& self) {
    search_together(buffers_, self);
    cuts_ = buffers_.search.take();
    self.attempt([&] { add_up(by_count); });
    buffers_.messages.run(sums_, Butterfly::to_owners, {}, self);
    const double largest = largest_share(total_weight);
    sums_.clear();
    buffers_.messages.run(sums_, Butterfly::to_owners, {0, largest}, self);
    return sums_.flags()[1];
}

/// Returns all cuts if each rank has and gets them; otherwise those above the points and the parts
/// of this rank.
Cuts SpreadReuse::kept_cuts() const {
    if (was_whole_ && options_.cuts == HeldCuts::whole)
        return {cuts_.dimension, cuts_.num_parts, cuts_.tree, {}, cuts_.shape};
    std::vector<Part> needed;
    const auto [first, end] = parts_on(sums_.rank(), cuts_.num_parts, sums_.num_ranks());
    for (Part part = first; part < end; ++part) needed.push_back(part);
    for (const auto& [part, weight] : weights_) needed.push_back(part);
    std::ranges::sort(needed);
    Cuts kept{cuts_.dimension, cuts_.num_parts, {}, {}, cuts_.shape};
    for (std::size_t k = 0; k < cuts_.nodes.size(); ++k) {
        const Descent at = node_at(cuts_, static_cast<std::size_t>(cuts_.nodes[k]));
        const auto next = std::ranges::lower_bound(needed, at.first_part);
        if (next == needed.end() || *next >= at.first_part + at.num_parts) continue;
        kept.nodes.push_back(cuts_.nodes[k]);
        kept.tree.push_back(cuts_.tree[k]);
    }
    return kept;
}

bool SpreadReuse::ends(const Verdict& verdict, Balance& result, Participant& self) {
    Report& report = result.report;
    const double imbalance = measure(verdict.weight(), verdict.is_counted(), self);
    if (report.details.num_points > 0) {
        report_measured(imbalance, options_.imbalance_tolerance, report);
        if (!report.within_tolerance) return false;
    }
    self.attempt([&] { result.cuts = kept_cuts(); });
    agree(self);
    report.details.rounds = report.details.num_points > 0 ? 1 : 0;
    return true;
}

}  // namespace rrcb
