#include "refinement/level_search_mpi.hpp"

#include "bisection/bisection.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"
#include "refinement/sample.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

CutSearch start_search(const Node& node, const Refinement& context) {
    const Options& options = context.options;
    CutSearch search;
    const Cut& estimated = context.estimate.cuts.tree[node.at.node];
    search.cut.axis = estimated.axis;
    search.num_axes = options.plain_cuts ? 1 : context.binned.dimension();
    search.divides = options.coincident == Coincident::divide && !options.plain_cuts ? 1 : 0;
    search.cut.at.fill(-infinity);
    search.lower = context.estimate.brackets[node.at.node].lower;
    search.upper = context.estimate.brackets[node.at.node].upper;
    search.quantum = quantum_for(node.weight);
    return search;
}

/// The tolerance with which the smallest of the parts still holds whole points, where all of them
/// weigh the same: where 16.16 points are allowed it can have no more than 16.
double attainable_tolerance(std::span<const double> sizes, const Refinement& context) {
    const double tolerance = context.options.imbalance_tolerance;
    const double common_weight = context.estimate.common_weight;
    if (common_weight == 0) return tolerance;
    double smallest = infinity;
    for (const double size : sizes)
        if (size > 0) smallest = std::min(smallest, size * context.weight_per_size);
    return std::max(1.0,
                    std::floor(tolerance * smallest / common_weight) * common_weight / smallest);
}

/// Target of a node's cut, by what the node was counted to weigh. A part may end up too heavy by
/// the tolerance in all; what is left of it at this node is shared evenly by the levels below.
CutTarget target_of(const Node& node, double weight, const Refinement& context) {
    const auto sizes = context.sizes_of(node.at);
    CutTarget target;
    target.target = share_below(sizes) * weight;
    target.slack = context.estimate.common_weight / 2;
    if (context.exactly || !(weight > 0)) return target;
    const double ideal = context.weight_per_size * std::accumulate(sizes.begin(), sizes.end(), 0.0);
    const int levels = std::bit_width(static_cast<unsigned>(node.at.num_parts - 1));
    const double growth =
        std::pow(attainable_tolerance(sizes, context) * ideal / weight, 1.0 / levels);
    target.slack =
        std::max(target.slack, (growth - 1) * std::min(target.target, weight - target.target));
    return target;
}

bool is_counting(const CutSearch& search) {
    return search.stage < CutSearch::gathering;
}

bool is_sampling(const CutSearch& search) {
    return search.stage == CutSearch::sampling;
}

bool is_gathering(const CutSearch& search) {
    return search.stage == CutSearch::gathering;
}

bool is_over(const CutSearch& search) {
    return search.stage > CutSearch::gathering;
}

/// This rank's histogram or sample for search number `k`.
void count_search(std::size_t k, Refinement& context) {
    RefinementBuffers& room = context.room;
    Histograms& histograms = room.histograms;
    const CutSearch& search = room.searches[k];
    if (is_sampling(search)) room.samples.push_back(histograms.size());
    const std::span<double> histogram = histograms.add();
    if (is_sampling(search)) {
        const std::span<double> sample = clear_to_sample(context.binned.dimension(), histogram);
        room.local[k].add_candidates(mpi::rank_of(context.self.comm), sample);
    } else {
        context.self.attempt([&] { room.local[k].count(search, histograms.layout(), histogram); });
    }
    if (context.self.failure.failed) mark_failed(histogram);
}

/// The root's decision on search number `k`, by its joined histogram.
void decide_search(std::size_t k, std::span<const double> histogram, Refinement& context) {
    RefinementBuffers& room = context.room;
    CutSearch& search = room.searches[k];
    const HistogramLayout& layout = room.histograms.layout();
    if (search.stage == CutSearch::sampling) {
        search.stage = CutSearch::over_splitters;
    } else if (search.stage == CutSearch::over_splitters) {
        decide_by_splitters(search, room.targets[k], layout, room.local[k].splitters(), histogram);
    } else {
        const auto weights = histogram.subspan(layout.num_extents, layout.num_slots());
        // What the node weighs is known when all of it has been counted.
        if (search.stage == CutSearch::over_fragments)
            room.targets[k] = target_of(
                *room.searched[k], std::accumulate(weights.begin(), weights.end(), 0.0), context);
        decide_by_bins(search, room.targets[k], layout, histogram);
    }
}

void count_and_decide(Refinement& context) {
    RefinementBuffers& room = context.room;
    Histograms& histograms = room.histograms;
    histograms.clear();
    room.samples.clear();
    for (std::size_t k = 0; k < room.searches.size(); ++k)
        if (is_counting(room.searches[k])) count_search(k, context);
    if (histograms.size() == 0) return;
    histograms.join(root, context.self.comm);
    if (!context.is_root) return;
    context.told_of_failure |= histograms.any_failed();
    if (context.told_of_failure) return;
    std::size_t next = 0;
    context.self.attempt([&] {
        for (std::size_t k = 0; k < room.searches.size(); ++k)
            if (is_counting(room.before[k])) decide_search(k, histograms.joined(next++), context);
    });
}

void gather_and_decide(Refinement& context) {
    RefinementBuffers& room = context.room;
    Candidates& candidates = room.candidates;
    if (std::ranges::none_of(room.before, is_gathering)) return;
    candidates.clear();
    context.self.attempt([&] {
        for (std::size_t k = 0; k < room.before.size(); ++k)
            if (is_gathering(room.before[k])) candidates.add(k, room.local[k]);
    });
    if (context.self.failure.failed) candidates.lose();
    candidates.gather(root, context.self.comm);
    if (!context.is_root) return;
    context.told_of_failure |= candidates.any_failed();
    if (context.told_of_failure) return;
    context.self.attempt([&] {
        const auto lists = candidates.lists(room.before.size());
        for (std::size_t k = 0; k < room.before.size(); ++k)
            if (is_gathering(room.before[k]))
                decide_among(room.searches[k], room.targets[k], lists[k],
                             context.binned.dimension());
    });
}

/// The last word of the root in a round: it ends all searches where a rank can't go on; it lets no
/// more candidates travel at once than a few messages hold, and makes room for them before others
/// send them.
void conclude(Refinement& context) {
    constexpr GlobalCount most_gathered_at_once = 64 * most_gathered;
    RefinementBuffers& room = context.room;
    GlobalCount num_points = 0;
    for (std::size_t k = 0; k < room.searches.size(); ++k) {
        CutSearch& search = room.searches[k];
        if (!is_gathering(search)) continue;
        const GlobalCount more = room.targets[k].num_candidates;
        if (num_points + more <= most_gathered_at_once) {
            num_points += more;
        } else {
            search.stage = CutSearch::sampling;
        }
    }
    context.self.attempt(
        [&] { room.candidates.expect(num_points, mpi::size_of(context.self.comm)); });
    if (!context.self.failure.failed && !context.told_of_failure) return;
    for (CutSearch& search : room.searches) search.stage = CutSearch::abandoned;
}

/// Brings what this rank knows of the searches up to what the root decided. Collective where it
/// has found splitters.
void follow(Refinement& context) {
    RefinementBuffers& room = context.room;
    Histograms& histograms = room.histograms;
    histograms.broadcast_samples(room.samples, root, context.self.comm);
    context.self.attempt([&] {
        std::size_t next = 0;
        for (std::size_t k = 0; k < room.local.size(); ++k) {
            const CutSearch& search = room.searches[k];
            if (is_sampling(room.before[k]))
                room.local[k].take_splitters(splitters_of(
                    positions_in(histograms.sample(next++), context.binned.dimension()),
                    order_of(search), histograms.layout()));
            room.local[k].keep_chosen(room.before[k], search, histograms.layout());
        }
    });
}

}  // namespace

bool needs_search(const Node& node, const Refinement& context) {
    const double share = share_below(context.sizes_of(node.at));
    return share > 0 && share < 1 && node.weight > 0;
}

void start_level(Refinement& context) {
    RefinementBuffers& room = context.room;
    room.searched.clear();
    room.searches.clear();
    room.targets.clear();
    room.local.clear();
    for (const Node& node : room.nodes) {
        if (!needs_search(node, context)) continue;
        room.searched.push_back(&node);
        room.searches.push_back(start_search(node, context));
        room.targets.emplace_back();
        room.local.emplace_back(node.fragments, context.points);
    }
}

/// Searches all cuts of a level at once.
void search_level(Refinement& context) {
    RefinementBuffers& room = context.room;
    // In each round every search that is not over narrows what its cut may lie in, or ends.
    while (!std::ranges::all_of(room.searches, is_over)) {
        room.before = room.searches;
        count_and_decide(context);
        gather_and_decide(context);
        if (context.is_root) conclude(context);
        mpi::broadcast(std::as_writable_bytes(std::span(room.searches)), root, context.self.comm);
        context.abandoned = room.searches[0].stage == CutSearch::abandoned;
        if (context.abandoned) return;
        follow(context);
        ++context.measured.rounds;
    }
}

}  // namespace rrcb
