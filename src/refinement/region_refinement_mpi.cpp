#include "refinement/region_refinement_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace rrcb {

namespace {

/// What a rank tells with its records: that it searches, and how uneven the parts are so far.
Flags flags_of(const std::optional<RegionSearch>& search) {
    if (!search) return {};
    return {0, search->is_searching() ? 1.0 : 0.0, search->imbalance()};
}

}  // namespace

RegionRefinement::RegionRefinement(int rank, int num_ranks)
    : butterfly_(rank, num_ranks, RegionSearch::join) {}

Refined RegionRefinement::refine(const Regions& regions, RegionTree tree,
                                 const BinnedPoints& binned, std::span<Part> parts,
                                 Participant& self) {
    SortedPoints points;
    self.attempt([&] { points = sort_by_cell(binned); });
    Refined refined = search(regions, tree, points, parts, self);
    const bool missed = refined.imbalance > tree.rule.tolerance;
    if (!missed || std::exchange(tree.rule.is_exact, true)) return refined;
    std::vector<Part> before;
    self.attempt([&] { before.assign(parts.begin(), parts.end()); });
    const Regions all_in_one{{regions.cuts.dimension, 1, {}}, {&tree.weight, 1}, regions.box};
    Refined exact = search(all_in_one, tree, points, parts, self);
    exact.rounds += refined.rounds;
    if (exact.imbalance < refined.imbalance) return exact;
    refined.rounds = exact.rounds;
    std::ranges::copy(before, parts.begin());
    return refined;
}

/// Runs one search; takes the points and gives them back. Collective.
Refined RegionRefinement::search(const Regions& regions, const RegionTree& tree,
                                 SortedPoints& points, std::span<Part> parts, Participant& self) {
    std::optional<RegionSearch> search;
    self.attempt(
        [&] { search.emplace(tree, butterfly_.rank(), regions, std::move(points), parts); });
    Refined refined;
    // Which messages follow is the same on all ranks, as all know the same flags.
    for (;; ++refined.rounds) {
        butterfly_.clear();
        self.attempt([&] { search->ask(butterfly_); });
        messages_.run(butterfly_, Butterfly::to_owners, flags_of(search), self);
        if (butterfly_.flags()[1] == 0) break;
        self.attempt([&] { search->decide(butterfly_); });
        messages_.run(butterfly_, Butterfly::back, {}, self);
        self.attempt([&] { search->follow(butterfly_); });
    }
    refined.imbalance = butterfly_.flags()[2];
    refined.coincident_cuts =
        regions.num_coincident + mpi::sum_of(search->num_coincident(), self.comm);
    self.attempt([&] { refined.cuts = search->cuts(); });
    points = search->take_points();
    return refined;
}

}  // namespace rrcb
