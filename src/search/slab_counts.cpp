#include "search/slab_counts.hpp"

#include "cuts/tree.hpp"
#include "passes/assignment.hpp"

#include <algorithm>
#include <functional>

namespace rrcb {

namespace {

/// A moving cut on the way to a part.
struct Step {
    Descent at;
    bool above;
};

void add_ways(const Cuts& cuts, std::span<const Slab> slabs, const Descent& at,
              std::vector<Step>& way, std::vector<std::vector<Step>>& ways) {
    if (at.is_part()) {
        ways.push_back(way);
        return;
    }
    const bool moves = slabs[at.node].moves();
    if (moves) way.push_back({at, false});
    add_ways(cuts, slabs, at.lower(), way, ways);
    if (moves) way.back().above = true;
    add_ways(cuts, slabs, at.upper(), way, ways);
    if (moves) way.pop_back();
}

/// Returns the moving cuts on the way to each part.
std::vector<std::vector<Step>> ways_to_parts(const Cuts& cuts, std::span<const Slab> slabs) {
    std::vector<Step> way;
    std::vector<std::vector<Step>> ways;
    add_ways(cuts, slabs, root_of(cuts), way, ways);
    return ways;
}

/// Returns the part of a position if it were on the other side of the cut of a node.
Part part_across(const Cuts& cuts, const Step& step, const Vector& position) {
    Descent at = step.above ? step.at.lower() : step.at.upper();
    while (!at.is_part()) {
        const Cut& cut = cuts.tree[at.node];
        const int axis = cut.axis;
        const bool above = position[axis] == cut.at[axis] ? is_above(cut, position, cuts.dimension)
                                                          : position[axis] > cut.at[axis];
        at = above ? at.upper() : at.lower();
    }
    return at.first_part;
}

}  // namespace

void count_in_slabs(const Collected& collected, std::span<const Part> parts, const Cuts& cuts,
                    std::span<const Slab> slabs, std::span<double> counts) {
    const std::vector<std::vector<Step>> ways = ways_to_parts(cuts, slabs);
    for (LocalIndex i = 0; i < collected.count(); ++i) {
        const Vector position = collected.position(i);
        const Part part = parts[i];
        for (const Step& step : ways[part]) {
            const Slab& slab = slabs[step.at.node];
            const Cut& cut = cuts.tree[step.at.node];
            const int axis = cut.axis;
            const double x = position[axis];
            if (!(x >= slab.lower && x < slab.upper)) continue;
            const auto bin = bin_in(counts, step.at, slab, step.above,
                                    bin_of(slab, cut.at[axis], step.above, x));
            const Part across = part_across(cuts, step, position);
            bin[part - step.at.first_part] += collected.weight(i);
            bin[across - step.at.first_part] += collected.weight(i);
        }
    }
}

void assign_collected(const Cuts& cuts, const Collected& collected, std::vector<Part>& parts,
                      std::span<double> part_weights) {
    parts.resize(collected.count());
    const PartTotals totals = assign_and_count(
        cuts, interleaved_points(collected.coordinates, collected.dimension, collected.weights),
        parts);
    std::ranges::transform(collected.settled.weights, totals.weights, part_weights.begin(),
                           std::plus<>());
}

}  // namespace rrcb
