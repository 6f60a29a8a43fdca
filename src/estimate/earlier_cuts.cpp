#include "estimate/earlier_cuts.hpp"

#include "arithmetic/infinity.hpp"
#include "bisection/bisection.hpp"
#include "cuts/tree.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace rrcb {

namespace {

void bracket_node(const Cuts& cuts, const Descent& at, Box box, int depth,
                  std::vector<Bracket>& brackets) {
    if (at.is_part()) return;
    const Cut& cut = cuts.tree[at.node];
    const int axis = cut.axis;
    const double value = std::clamp(cut.at[axis], box.lower[axis], box.upper[axis]);
    const double margin = expected_error(depth);
    brackets.push_back({std::lerp(value, box.lower[axis], 2 * margin),
                        std::nextafter(std::lerp(value, box.upper[axis], 2 * margin), infinity)});
    Box below = box;
    below.upper[axis] = value;
    bracket_node(cuts, at.lower(), below, depth + 1, brackets);
    box.lower[axis] = value;
    bracket_node(cuts, at.upper(), box, depth + 1, brackets);
}

/// Leaves nothing in parts of size 0, and makes the cut a plane if the options ask for planes.
void fit(const Options& options, const Descent& at, Cut& cut) {
    const int axis = cut.axis;
    double value = cut.at[axis];
    if (!options.part_sizes.empty()) {
        const std::span sizes(options.part_sizes);
        const double share =
            share_below(sizes.subspan(at.first_part, at.num_parts), at.lower_parts());
        if (share <= 0) value = -infinity;
        if (share >= 1) value = infinity;
    }
    if (options.axes.plain || value != cut.at[axis]) cut.at.fill(-infinity);
    cut.divides = 0;
    cut.at[axis] = value;
}

}  // namespace

Cuts fitted(Cuts cuts, const Options& options) {
    for (std::size_t k = 0; k < cuts.tree.size(); ++k) {
        const std::size_t node = is_whole(cuts) ? k : cuts.nodes[k];
        fit(options, node_at(cuts, node), cuts.tree[k]);
    }
    return cuts;
}

void bracket_earlier(const Cuts& cuts, const Box& box, std::vector<Bracket>& brackets) {
    if (box.lower[0] <= box.upper[0]) bracket_node(cuts, root_of(cuts), box, 0, brackets);
}

}  // namespace rrcb
