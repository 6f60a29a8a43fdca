#include "refinement_mpi.hpp"

#include "agreement_mpi.hpp"
#include "binned_assignment.hpp"
#include "brackets.hpp"
#include "mpi/communicator.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What the functions of the refinement share.
struct Context {
    Estimate& estimate;
    const Options& options;
    const BinnedPoints& binned;
    RefinementRoom& room;
    Member& me;
    bool is_root;
    double weight_per_size;  ///< of a part
    SortedPoints points{};   ///< where cuts are searched
    Measured measured{};
    bool told_of_failure = false;  ///< of another rank; at the root only
    bool abandoned = false;        ///< the root told all to stop

    std::span<const double> sizes_of(const Descent& at) const {
        return std::span(options.part_sizes)
            .subspan(static_cast<std::size_t>(at.first), static_cast<std::size_t>(at.num_parts));
    }
};

bool needs_search(const Node& node, const Context& context) {
    const double share = share_below(context.sizes_of(node.at));
    return share > 0 && share < 1 && node.weight > 0;
}

CutSearch start_search(const Node& node, const Context& context) {
    CutSearch search;
    const Cut& estimated = context.estimate.cuts.tree[node.at.node];
    search.cut.axis = estimated.axis;
    search.num_axes = context.options.plain_cuts ? 1 : context.binned.dimension();
    search.cut.at.fill(-infinity);
    search.lower = context.estimate.brackets[node.at.node].lower;
    search.upper = context.estimate.brackets[node.at.node].upper;
    return search;
}

/// The tolerance with which the smallest of the parts still holds whole points, where all of them
/// weigh the same: where 16.16 points are allowed it can have no more than 16.
double attainable_tolerance(std::span<const double> sizes, const Context& context) {
    const double tolerance = context.options.imbalance_tolerance;
    const double grain = context.estimate.grain;
    if (grain == 0) return tolerance;
    double smallest = infinity;
    for (const double size : sizes)
        if (size > 0) smallest = std::min(smallest, size * context.weight_per_size);
    return std::max(1.0, std::floor(tolerance * smallest / grain) * grain / smallest);
}

/// Target of a node's cut. A part may end up too heavy by the tolerance in all; what is left of it
/// at this node is shared evenly by the levels below.
CutTarget target_of(const Node& node, const Context& context) {
    const auto sizes = context.sizes_of(node.at);
    CutTarget target;
    target.target = share_below(sizes) * node.weight;
    if (context.options.refine == Refine::exact) {
        target.slack = context.estimate.grain / 2;
        return target;
    }
    const double ideal = context.weight_per_size * std::accumulate(sizes.begin(), sizes.end(), 0.0);
    const int levels = std::bit_width(static_cast<unsigned>(node.at.num_parts - 1));
    const double growth =
        std::pow(attainable_tolerance(sizes, context) * ideal / node.weight, 1.0 / levels);
    target.slack = std::max(context.estimate.grain / 2,
                            (growth - 1) * std::min(target.target, node.weight - target.target));
    return target;
}

bool is_counting(const CutSearch& search) {
    return search.stage == CutSearch::over_fragments || search.stage == CutSearch::over_candidates;
}

bool is_gathering(const CutSearch& search) {
    return search.stage == CutSearch::gathering;
}

bool is_over(const CutSearch& search) {
    return search.stage == CutSearch::done || search.stage == CutSearch::abandoned;
}

void count_and_decide(Context& context) {
    RefinementRoom& room = context.room;
    Histograms& histograms = room.histograms;
    histograms.clear();
    for (std::size_t k = 0; k < room.searches.size(); ++k) {
        if (!is_counting(room.searches[k])) continue;
        const std::span<double> histogram = histograms.add();
        context.me.locally(
            [&] { room.local[k].count(room.searches[k], histograms.layout(), histogram); });
        histogram[HistogramLayout::failed] = context.me.failure.failed ? 1 : 0;
    }
    if (histograms.size() == 0) return;
    histograms.join(root, context.me.comm);
    if (!context.is_root) return;
    context.told_of_failure |= histograms.any_failed();
    std::size_t next = 0;
    for (std::size_t k = 0; k < room.searches.size(); ++k)
        if (is_counting(room.before[k]))
            decide(room.searches[k], room.targets[k], histograms.layout(),
                   histograms.joined(next++));
}

void gather_and_decide(Context& context) {
    RefinementRoom& room = context.room;
    Candidates& candidates = room.candidates;
    if (std::ranges::none_of(room.before, is_gathering)) return;
    candidates.clear();
    context.me.locally([&] {
        for (std::size_t k = 0; k < room.before.size(); ++k)
            if (is_gathering(room.before[k])) candidates.add(k, room.local[k]);
    });
    if (context.me.failure.failed) candidates.lose();
    candidates.gather(root, context.me.comm);
    if (!context.is_root) return;
    context.told_of_failure |= candidates.any_failed();
    if (context.told_of_failure) return;
    context.me.locally([&] {
        const auto lists = candidates.lists(room.before.size());
        for (std::size_t k = 0; k < room.before.size(); ++k)
            if (is_gathering(room.before[k]))
                decide_among(room.searches[k], room.targets[k], lists[k],
                             context.binned.dimension());
    });
}

/// The last word of the root in a round: it ends all searches where a rank can't go on, and before
/// others send their candidates it makes sure that there is room for them.
void conclude(Context& context) {
    RefinementRoom& room = context.room;
    GlobalCount num_points = 0;
    for (std::size_t k = 0; k < room.searches.size(); ++k) {
        if (is_gathering(room.searches[k])) num_points += room.targets[k].num_candidates;
    }
    context.me.locally([&] { room.candidates.expect(num_points, mpi::size_of(context.me.comm)); });
    if (!context.me.failure.failed && !context.told_of_failure) return;
    for (CutSearch& search : room.searches) search.stage = CutSearch::abandoned;
}

/// Searches all cuts of a level at once.
void search_level(Context& context) {
    RefinementRoom& room = context.room;
    while (!std::ranges::all_of(room.searches, is_over)) {
        room.before = room.searches;
        count_and_decide(context);
        gather_and_decide(context);
        if (context.is_root) conclude(context);
        mpi::broadcast(std::as_writable_bytes(std::span(room.searches)), root, context.me.comm);
        context.abandoned = room.searches[0].stage == CutSearch::abandoned;
        if (context.abandoned) return;
        context.me.locally([&] {
            for (std::size_t k = 0; k < room.local.size(); ++k)
                room.local[k].keep_chosen(room.before[k], room.searches[k],
                                          room.histograms.layout().num_bins);
        });
        ++context.measured.rounds;
    }
}

void start_level(Context& context) {
    RefinementRoom& room = context.room;
    room.searches.clear();
    room.targets.clear();
    room.local.clear();
    for (const Node& node : room.nodes) {
        if (!needs_search(node, context)) continue;
        room.searches.push_back(start_search(node, context));
        room.targets.push_back(target_of(node, context));
        room.local.emplace_back(node.fragments, context.points);
    }
}

/// Goes on with the nodes below, by the cuts that the level found.
void descend(Context& context) {
    RefinementRoom& room = context.room;
    room.children.clear();
    auto search = room.searches.begin();
    for (Node& node : room.nodes) {
        Cut& cut = context.estimate.cuts.tree[node.at.node];
        double below = 0;
        if (needs_search(node, context)) {
            cut = search->cut;
            below = search->below;
            context.measured.coincident_cuts += search++->coincident;
        } else if (node.weight > 0) {
            below = share_below(context.sizes_of(node.at)) > 0 ? node.weight : 0;
            cut.at.fill(-infinity);
            if (below > 0) cut.at[static_cast<std::size_t>(cut.axis)] = infinity;
        }
        std::pair<std::vector<Fragment>, std::vector<Fragment>> halves;
        context.me.locally([&] { halves = split(node.fragments, cut, context.points); });
        room.children.push_back({node.at.lower(), std::move(halves.first), below});
        room.children.push_back({node.at.upper(), std::move(halves.second), node.weight - below});
    }
    std::swap(room.nodes, room.children);
}

/// True when the estimated cuts are good enough as they are; then `parts` is complete, and no rank
/// has failed.
bool accept_estimate(Context& context, std::span<Part> parts) {
    RefinementRoom& room = context.room;
    context.me.locally([&] {
        std::ranges::copy(assign(context.estimate.cuts, context.binned, parts),
                          room.part_weights.begin());
    });
    room.part_weights.back() = context.me.failure.failed ? 1 : 0;
    mpi::check(MPI_Reduce(room.part_weights.data(), room.sums.data(),
                          static_cast<int>(room.part_weights.size()), MPI_DOUBLE, MPI_SUM, root,
                          context.me.comm),
               "MPI_Reduce");
    struct {
        double imbalance = 1;
        double failed = 0;
    } look;
    if (context.is_root) {
        const std::span<const double> sums(room.sums);
        look = {imbalance(sums.first(sums.size() - 1), context.options.part_sizes), sums.back()};
    }
    mpi::check(MPI_Bcast(&look, 2, MPI_DOUBLE, root, context.me.comm), "MPI_Bcast");
    if (look.failed > 0) agree(context.me);
    ++context.measured.rounds;
    context.measured.imbalance = look.imbalance;
    return look.imbalance <= context.options.imbalance_tolerance;
}

/// Finds the cuts of one level after the other, and the parts at the end.
void search_all_levels(Context& context, std::span<Part> parts) {
    RefinementRoom& room = context.room;
    std::vector<Node>& nodes = room.nodes;
    nodes.push_back({root_of(context.estimate.cuts), {}, context.estimate.total_weight});
    context.me.locally([&] {
        context.points = sort_by_cell(context.binned);
        nodes[0].fragments = cell_fragments(context.points);
    });
    while (!nodes.empty()) {
        std::erase_if(nodes, [&](const Node& node) {
            if (!node.at.is_part()) return false;
            write_part(node.fragments, node.at.first, context.points, parts);
            room.part_weights[static_cast<std::size_t>(node.at.first)] = node.weight;
            return true;
        });
        start_level(context);
        search_level(context);
        if (context.abandoned) return;
        descend(context);
    }
    const std::span<const double> weights(room.part_weights);
    context.measured.imbalance =
        imbalance(weights.first(weights.size() - 1), context.options.part_sizes);
}

}  // namespace

Measured refine(Estimate& estimate, const Options& options, const BinnedPoints& binned,
                RefinementRoom& room, std::span<Part> parts, Member& me) {
    const auto& sizes = options.part_sizes;
    const double weight_per_size =
        estimate.total_weight / std::accumulate(sizes.begin(), sizes.end(), 0.0);
    Context context{estimate,       options, binned, room, me, mpi::rank_of(me.comm) == root,
                    weight_per_size};
    if (options.refine == Refine::tolerance && accept_estimate(context, parts))
        return context.measured;
    search_all_levels(context, parts);
    agree(me);
    return context.measured;
}

}  // namespace rrcb
