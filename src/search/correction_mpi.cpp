#include "search/correction_mpi.hpp"

#include "arithmetic/infinity.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rrcb {

namespace {

/// Returns the length of the histograms that a search of so many cuts sends, one for each cut. More
/// corrections than fit in it are not worth their messages.
std::size_t length_of_search(std::size_t num_cuts) {
    return num_cuts * HistogramLayout{}.length();
}

/// Returns the intervals of slabs. Points at a cut that stays may be on either side.
std::vector<Bracket> intervals_of(std::span<const Slab> slabs) {
    std::vector<Bracket> intervals;
    for (const Slab& slab : slabs)
        intervals.push_back(
            {slab.lower, std::max(slab.upper, std::nextafter(slab.lower, infinity))});
    return intervals;
}

}  // namespace

Correction::Correction(const Descent& top, bool is_root, OpenPoints& memory) : points_(memory) {
    const SlabTotals most = most_slabs(top);
    const std::size_t length = std::min(most.counts, length_of_search(most.moving)) + 1;
    slabs_.resize(most.moving);
    here_ = std::make_unique_for_overwrite<double[]>(length);
    if (is_root) joined_ = std::make_unique_for_overwrite<double[]>(length);
    values_.resize(most.moving + 1);
    expected_.resize(top.num_parts);
}

int Correction::run(const TargetRule& rule, PointPasses& points, std::span<const Bracket> brackets,
                    Cuts& cuts, PartSums& sums, double& imbalance, Participant& self) {
    if (!rule.are_points_light()) return 0;
    totals_ = lay_slabs(rule, cuts, brackets, sums.sums(), slabs_);
    const std::size_t most_sent = length_of_search(totals_.moving);
    std::size_t sent = totals_.counts;
    if (totals_.moving == 0 || sent > most_sent) return 0;
    self.attempt([&] {
        points.collect(cuts, intervals_of(slabs_), true, points_);
        assign_collected(cuts, points_, points_.parts, sums.here());
    });
    int rounds = 0;
    double before = 0;
    do {
        before = imbalance;
        correct_together(rule, sums, cuts, self);
        self.attempt([&] { assign_collected(cuts, points_, points_.parts, sums.here()); });
        imbalance = sums.add_up(rule.part_sizes, self);
        rounds += 2;
        sent += totals_.counts;
    } while (imbalance > rule.tolerance && sent <= most_sent && imbalance - 1 < (before - 1) / 2);
    self.attempt([&] { points.settle(points_, points_.parts); });
    return rounds;
}

/// Moves the cuts by the counts of all ranks in their slabs. Collective; throws if a rank failed.
void Correction::correct_together(const TargetRule& rule, const PartSums& sums, Cuts& cuts,
                                  Participant& self) {
    const std::span here(here_.get(), totals_.counts + 1);
    std::ranges::fill(here, 0.0);
    self.attempt(
        [&] { count_in_slabs(points_, points_.parts, cuts, slabs_, here.first(totals_.counts)); });
    here.back() = self.failed() ? 1 : 0;
    mpi::check(MPI_Reduce(here.data(), joined_.get(), mpi::to_int(std::ssize(here)), MPI_DOUBLE,
                          MPI_SUM, root, self.comm),
               "MPI_Reduce");
    const auto answer = std::span(values_).first(totals_.moving + 1);
    if (mpi::rank_of(self.comm) == root) {
        const std::span<const double> joined(joined_.get(), here.size());
        answer.back() = joined.back();
        std::ranges::copy(sums.sums(), expected_.begin());
        correct(rule, cuts, slabs_, expected_, joined.first(totals_.counts), answer);
    }
    mpi::broadcast(std::as_writable_bytes(answer), root, self.comm);
    if (answer.back() > 0) fail_together(some_rank, self);
    move(cuts);
}

/// Moves the cuts to the places that the root found.
void Correction::move(Cuts& cuts) const {
    for (std::size_t k = 0; k < cuts.tree.size(); ++k) {
        if (!slabs_[k].moves()) continue;
        Cut& cut = cuts.tree[k];
        const double value = values_[slabs_[k].number];
        if (value != cut.at[cut.axis]) cut = plane(cut.axis, value);
    }
}

}  // namespace rrcb
