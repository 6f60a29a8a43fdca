#include "refinement/refinement_mpi.hpp"

#include "bisection/bisection.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "cuts/binned_assignment.hpp"
#include "refinement/level_search_mpi.hpp"
#include "refinement/part_sums_mpi.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where in its lot each rank begins, for the cuts that divide one. Collective where there are any.
void place_in_lots(Refinement& context) {
    RefinementBuffers& room = context.room;
    room.lots.clear();
    for (std::size_t k = 0; k < room.searches.size(); ++k) {
        const CutSearch& search = room.searches[k];
        if (!(search.lot_below > 0)) continue;
        const double weight = weight_at(search.cut, room.searched[k]->fragments, context.points);
        room.lots.push_back(rounded_to(search.quantum, weight));
    }
    if (room.lots.empty()) return;
    const bool is_first = mpi::rank_of(context.self.comm) == 0;
    mpi::check(MPI_Exscan(MPI_IN_PLACE, room.lots.data(), mpi::to_int(std::ssize(room.lots)),
                          MPI_DOUBLE, MPI_SUM, context.self.comm),
               "MPI_Exscan");
    // Where there are no ranks before it MPI leaves what was there.
    if (is_first) std::ranges::fill(room.lots, 0.0);
}

/// Keeps all points off a side whose parts have no size; another cut without a search stays.
void set_aside(const Node& node, const Refinement& context, Cut& cut) {
    const double share = share_below(context.sizes_of(node.at));
    if (share > 0 && share < 1) return;
    cut.divides = 0;
    cut.at.fill(-infinity);
    if (share > 0) cut.at[static_cast<std::size_t>(cut.axis)] = infinity;
}

/// Goes on with the nodes below, by the cuts that the level found.
void descend(Refinement& context) {
    RefinementBuffers& room = context.room;
    room.children.clear();
    auto search = room.searches.begin();
    auto lots = room.lots.begin();
    for (Node& node : room.nodes) {
        Cut& cut = context.estimate.cuts.tree[node.at.node];
        double below = 0;
        Lot lot;
        if (needs_search(node, context)) {
            cut = search->cut;
            below = search->below;
            lot.below = search->lot_below;
            if (lot.below > 0) lot.before = *lots++;
            cut.divides = lot.below > 0 ? 1 : 0;
            context.measured.coincident_cuts += search++->coincident;
        } else {
            set_aside(node, context, cut);
            below = share_below(context.sizes_of(node.at)) > 0 ? node.weight : 0;
        }
        std::pair<std::vector<Fragment>, std::vector<Fragment>> halves;
        context.self.attempt([&] { halves = split(node.fragments, cut, lot, context.points); });
        room.children.push_back({node.at.lower(), std::move(halves.first), below});
        room.children.push_back({node.at.upper(), std::move(halves.second), node.weight - below});
    }
    std::swap(room.nodes, room.children);
}

/// Adds up what the parts weigh on all ranks, on every rank. Collective; throws where one failed.
void measure(Refinement& context) {
    RefinementBuffers& room = context.room;
    context.measured.imbalance =
        add_up_parts(room.part_weights, room.sums, context.options.part_sizes, context.self);
}

/// True when there is nothing to search: the estimated cuts are good enough as they are, and
/// `parts` is complete, or the current parts are.
bool accept_estimate(Refinement& context, std::span<Part> parts) {
    context.self.attempt([&] {
        std::ranges::copy(assign(context.estimate.cuts, context.binned, parts),
                          context.room.part_weights.begin());
    });
    measure(context);
    ++context.measured.rounds;
    const double tolerance = context.options.imbalance_tolerance;
    return context.measured.imbalance <= tolerance ||
           context.estimate.current_imbalance <= tolerance;
}

/// Finds the cuts of one level after the other, and the parts at the end.
void search_all_levels(Refinement& context, std::span<Part> parts) {
    RefinementBuffers& room = context.room;
    std::vector<Node>& nodes = room.nodes;
    nodes.push_back({root_of(context.estimate.cuts), {}, context.estimate.total_weight});
    context.self.attempt([&] {
        context.points = sort_by_cell(context.binned);
        nodes[0].fragments = cell_fragments(context.points);
    });
    // All nodes are of one level; together with the parts written they hold every point once.
    while (!nodes.empty()) {
        std::erase_if(nodes, [&](const Node& node) {
            if (!node.at.is_part()) return false;
            room.part_weights[static_cast<std::size_t>(node.at.first_part)] =
                write_part(node.fragments, node.at.first_part, context.points, parts);
            return true;
        });
        start_level(context);
        search_level(context);
        if (context.abandoned) agree(context.self);
        place_in_lots(context);
        descend(context);
    }
    measure(context);
}

/// What a search ended with.
struct Outcome {
    std::vector<Cut> tree;
    std::vector<Part> parts;
    std::vector<double> sums;
    int coincident_cuts = 0;

    void swap_with(Refinement& context, std::span<Part> current) {
        std::swap(tree, context.estimate.cuts.tree);
        std::ranges::swap_ranges(parts, current);
        std::swap(sums, context.room.sums);
        std::swap(coincident_cuts, context.measured.coincident_cuts);
    }
};

/// Searches once more, without slack, and keeps the better of the two outcomes.
void search_exactly(Refinement& context, std::span<Part> parts) {
    Outcome before;
    context.self.attempt([&] {
        before = {context.estimate.cuts.tree,
                  {parts.begin(), parts.end()},
                  context.room.sums,
                  std::exchange(context.measured.coincident_cuts, 0)};
    });
    const double imbalance_before = context.measured.imbalance;
    context.exactly = true;
    search_all_levels(context, parts);
    if (context.measured.imbalance < imbalance_before) return;
    before.swap_with(context, parts);
    context.measured.imbalance = imbalance_before;
}

}  // namespace

Measured refine(Estimate& estimate, const Options& options, const BinnedPoints& binned,
                RefinementBuffers& room, std::span<Part> parts, Participant& self) {
    const auto& sizes = options.part_sizes;
    const double weight_per_size =
        estimate.total_weight / std::accumulate(sizes.begin(), sizes.end(), 0.0);
    Refinement context{estimate,       options, binned, room, self, mpi::rank_of(self.comm) == root,
                       weight_per_size};
    context.exactly = options.refine == Refine::exact;
    if (context.exactly || !accept_estimate(context, parts)) {
        search_all_levels(context, parts);
        const bool missed = context.measured.imbalance > options.imbalance_tolerance;
        if (missed && !context.exactly) search_exactly(context, parts);
    }
    room.sums.resize(context.num_parts());
    context.measured.part_weights = std::move(room.sums);
    return std::move(context.measured);
}

}  // namespace rrcb
