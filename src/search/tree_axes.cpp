// How a spread search finds the axes of free cuts.
#include "arithmetic/infinity.hpp"
#include "arithmetic/part_share.hpp"
#include "bisection/axis_choice.hpp"
#include "options/allowed_axes.hpp"
#include "search/marginal.hpp"
#include "search/tree_search.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb {

/// Returns the axes that free cuts may cross.
std::span<const int> TreeSearch::axes() const {
    return tree_.axes.empty() ? first_axes(dimension_) : tree_.axes;
}

/// Turns a search in the box of a node across another axis, before anything is counted.
void TreeSearch::turn(CutSearch& search, const Box& box, int axis) {
    search.cut.axis = axis;
    search.lower = box.lower[axis];
    search.upper = std::nextafter(box.upper[axis], infinity);
}

/// Returns the search in the box of a node across the first of its axes, or one that weighs a part.
CutSearch TreeSearch::first_search(const Descent& at, const Content& content) const {
    CutSearch search = search_across(0, {}, content.weight);
    const bool is_free = tree_.cut_axes.empty() || at.is_part();
    turn(search, content.box, is_free ? axes().front() : tree_.cut_axes[at.node]);
    return search;
}

/// Returns whether the points of a node are counted along all axes that the cut may cross.
bool TreeSearch::counts_all_axes(const Node& node) const {
    return !is_central() && tree_.cut_axes.empty() && node.search.stage == CutSearch::over_points;
}

/// Appends the sums of this rank along the axes behind the first.
void TreeSearch::count_other_axes(const Node& node, std::vector<double>& payload) const {
    const HistogramLayout layout = layout_of(node.search);
    const std::size_t num_sums = layout.length() - HistogramLayout::num_extents;
    CutSearch search = node.search;
    for (const int axis : axes().subspan(1)) {
        turn(search, node.content.box, axis);
        payload.resize(payload.size() + num_sums);
        const auto sums = std::span(payload).last(num_sums);
        count_along(axis, points_.points(), node.content.entries, bins_of(search, layout), layout,
                    search.quantum, sums);
    }
}

/// Turns a search across the axis to cut; returns the histogram along it.
std::vector<double> TreeSearch::choose_axis(const Node& node, std::span<const double> histogram,
                                            CutSearch& search) const {
    constexpr std::size_t num_extents = HistogramLayout::num_extents;
    const HistogramLayout layout = layout_of(search);
    const std::size_t num_sums = layout.length() - num_extents;
    std::vector<Marginal> marginals;
    for (const int axis : axes()) {
        const std::size_t first = num_extents + marginals.size() * num_sums;
        turn(search, node.content.box, axis);
        marginals.push_back(
            {axis, bins_of(search, layout), histogram.subspan(first, layout.num_slots())});
    }
    const int longest = longest_axis(node.found, axes(), nearly);
    auto best = static_cast<std::size_t>(std::ranges::find(axes(), longest) - axes().begin());
    const double target = node.target.target;
    if (!tree_.crosses_longest && target > 0)
        best =
            fewest_near(marginals, node.found, best, target, sum_of(counts_in(histogram, layout)));
    turn(search, node.content.box, marginals[best].axis);
    std::vector<double> along(histogram.begin(), histogram.begin() + num_extents);
    const auto sums = histogram.subspan(num_extents + best * num_sums, num_sums);
    along.insert(along.end(), sums.begin(), sums.end());
    return along;
}

}  // namespace rrcb
