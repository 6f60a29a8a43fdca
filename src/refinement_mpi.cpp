#include "refinement_mpi.hpp"

#include "agreement_mpi.hpp"
#include "brackets.hpp"
#include "cut_search.hpp"
#include "descent.hpp"
#include "histogram_mpi.hpp"
#include "mpi/communicator.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A node of the current level: what of it lies here, and what it weighs over all ranks.
struct Node {
    Descent at;
    std::vector<Fragment> fragments;
    double weight = 0;
};

/// What the functions of the refinement share.
struct Context {
    Estimate& estimate;
    const Options& options;
    SortedPoints& points;
    MPI_Comm comm;
    bool is_root;
    Measured measured{};
    Failure failure{};  ///< of this rank; it takes part with what it has until all can agree

    /// Runs a step that touches only what is here, unless an earlier one failed.
    template <class Step>
    void locally(Step&& step) {
        if (!failure.failed) failure = attempt(step);
    }

    std::span<const double> sizes_of(const Descent& at) const {
        return std::span(estimate.part_sizes)
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
    search.num_axes = context.options.plain_cuts ? 1 : context.points.dimension();
    search.cut.at.fill(-infinity);
    search.lower = context.estimate.brackets[node.at.node].lower;
    search.upper = context.estimate.brackets[node.at.node].upper;
    return search;
}

/// Target of a node's cut. A part may end up too heavy by the tolerance in all; what is left of it
/// at this node is shared evenly by the levels below.
CutTarget target_of(const Node& node, const Context& context) {
    const auto sizes = context.sizes_of(node.at);
    CutTarget target;
    target.target = share_below(sizes) * node.weight;
    if (context.options.refine == Refine::exact) {
        target.slack = context.points.weights.empty() ? 0.5 : 0;
        return target;
    }
    const auto& all = context.estimate.part_sizes;
    const double ideal =
        context.estimate.total_weight * (std::accumulate(sizes.begin(), sizes.end(), 0.0) /
                                         std::accumulate(all.begin(), all.end(), 0.0));
    const int levels = std::bit_width(static_cast<unsigned>(node.at.num_parts - 1));
    const double growth =
        std::pow(context.options.imbalance_tolerance * ideal / node.weight, 1.0 / levels);
    target.slack = std::max(0.0, growth - 1) * std::min(target.target, node.weight - target.target);
    return target;
}

/// The searches of one level, in step on all ranks.
struct Level {
    std::vector<CutSearch> searches;
    std::vector<CutTarget> targets;
    std::vector<LocalSearch> local;
    HistogramLayout layout;
};

bool is_counting(const CutSearch& search) {
    return search.stage == CutSearch::over_fragments || search.stage == CutSearch::over_candidates;
}

std::size_t count_in(const Level& level, CutSearch::Stage stage) {
    return static_cast<std::size_t>(
        std::count_if(level.searches.begin(), level.searches.end(),
                      [&](const CutSearch& search) { return search.stage == stage; }));
}

void count_and_decide(Level& level, const std::vector<CutSearch>& before, Context& context) {
    const std::size_t length = level.layout.length();
    std::vector<double> mine;
    for (std::size_t k = 0; k < before.size(); ++k) {
        if (!is_counting(before[k])) continue;
        mine.resize(mine.size() + length);
        const std::span<double> histogram = std::span(mine).last(length);
        std::fill_n(histogram.begin(), HistogramLayout::num_extents, -infinity);
        context.locally([&] { level.local[k].count(before[k], level.layout, histogram); });
    }
    if (mine.empty()) return;
    const std::vector<double> joined = join_histograms(mine, level.layout, root, context.comm);
    std::span<const double> left(joined);
    for (std::size_t k = 0; k < before.size() && context.is_root; ++k) {
        if (!is_counting(before[k])) continue;
        decide(level.searches[k], level.targets[k], level.layout, left.first(length));
        left = left.subspan(length);
    }
}

void gather_and_decide(Level& level, const std::vector<CutSearch>& before, Context& context) {
    std::vector<std::vector<double>> mine;
    for (std::size_t k = 0; k < before.size(); ++k) {
        if (before[k].stage != CutSearch::gathering) continue;
        std::vector<double>& records = mine.emplace_back();
        context.locally([&] { level.local[k].append_candidates(records); });
    }
    if (mine.empty()) return;
    const auto lists = gather_candidates(mine, root, context.comm);
    auto list = lists.begin();
    for (std::size_t k = 0; k < before.size() && context.is_root; ++k)
        if (before[k].stage == CutSearch::gathering)
            decide_among(level.searches[k], level.targets[k], *list++, context.points.dimension());
}

/// Searches all cuts of a level at once.
void run(Level& level, Context& context) {
    while (count_in(level, CutSearch::done) < level.searches.size()) {
        const std::vector<CutSearch> before = level.searches;
        count_and_decide(level, before, context);
        gather_and_decide(level, before, context);
        mpi::check(
            MPI_Bcast(level.searches.data(),
                      mpi::to_int(static_cast<std::int64_t>(before.size() * sizeof(CutSearch))),
                      MPI_BYTE, root, context.comm),
            "MPI_Bcast");
        for (std::size_t k = 0; k < before.size(); ++k) {
            context.locally([&] {
                level.local[k].keep_chosen(before[k], level.searches[k], level.layout.num_bins);
            });
        }
        ++context.measured.rounds;
    }
}

Level start_level(const std::vector<Node>& nodes, const Context& context) {
    Level level;
    for (const Node& node : nodes) {
        if (!needs_search(node, context)) continue;
        level.searches.push_back(start_search(node, context));
        level.targets.push_back(target_of(node, context));
        level.local.emplace_back(node.fragments, context.points);
    }
    return level;
}

/// The nodes below, with the cuts that the level found.
std::vector<Node> descend(std::vector<Node> nodes, const Level& level, Context& context) {
    std::vector<Node> children;
    auto search = level.searches.begin();
    for (Node& node : nodes) {
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
        context.locally([&] { halves = split(node.fragments, cut, context.points); });
        children.push_back({node.at.lower(), std::move(halves.first), below});
        children.push_back({node.at.upper(), std::move(halves.second), node.weight - below});
    }
    return children;
}

/// True when the estimated cuts are good enough as they are; then `parts` is complete.
bool accept_estimate(Context& context, std::span<Part> parts) {
    std::vector<double> weights(context.estimate.part_sizes.size());
    context.locally([&] { weights = assign(context.estimate.cuts, context.points, parts); });
    std::vector<double> sums(context.is_root ? weights.size() : 0);
    mpi::check(MPI_Reduce(weights.data(), sums.data(), static_cast<int>(weights.size()), MPI_DOUBLE,
                          MPI_SUM, root, context.comm),
               "MPI_Reduce");
    double measured = context.is_root ? imbalance(sums, context.estimate.part_sizes) : 0;
    mpi::check(MPI_Bcast(&measured, 1, MPI_DOUBLE, root, context.comm), "MPI_Bcast");
    ++context.measured.rounds;
    context.measured.imbalance = measured;
    return measured <= context.options.imbalance_tolerance;
}

/// Finds the cuts of one level after the other, and the parts at the end.
void search_all_levels(Context& context, std::span<Part> parts) {
    std::vector<double> part_weights(context.estimate.part_sizes.size());
    std::vector<Node> nodes{{root_of(context.estimate.cuts), {}, context.estimate.total_weight}};
    context.locally([&] { nodes[0].fragments = cell_fragments(context.points); });
    while (!nodes.empty()) {
        std::erase_if(nodes, [&](const Node& node) {
            if (!node.at.is_part()) return false;
            write_part(node.fragments, node.at.first, context.points, parts);
            part_weights[static_cast<std::size_t>(node.at.first)] = node.weight;
            return true;
        });
        Level level = start_level(nodes, context);
        run(level, context);
        nodes = descend(std::move(nodes), level, context);
    }
    context.measured.imbalance = imbalance(part_weights, context.estimate.part_sizes);
}

}  // namespace

Measured refine(Estimate& estimate, const Options& options, SortedPoints& points, MPI_Comm comm,
                std::span<Part> parts) {
    Context context{estimate, options, points, comm, mpi::rank_of(comm) == root};
    const bool accepted = options.refine == Refine::tolerance && accept_estimate(context, parts);
    if (!accepted) search_all_levels(context, parts);
    agree(context.failure, comm);
    return context.measured;
}

}  // namespace rrcb
