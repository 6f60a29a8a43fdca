// Chooses the axes of free cuts in a spread search.
#include "arithmetic/infinity.hpp"
#include "arithmetic/part_share.hpp"
#include "bisection/axis_choice.hpp"
#include "bisection/weighted_quantile.hpp"
#include "search/tree_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

/// Returns the weights in the bins of an axis as a one-dimensional domain. An edge above the
/// largest double is infinite.
StatisticalDomain domain_of(const Bins& bins, std::span<const double> slots) {
    StatisticalDomain domain{1};
    for (int bin = 0; bin + 2 < std::ssize(slots); ++bin)
        domain.patches.push_back(
            {{bins.edge(bin)},
             {std::min(bins.edge(bin + 1), std::numeric_limits<double>::max())},
             slots[bin + 1]});
    return domain;
}

}  // namespace

/// Makes a search start anew across another axis of the node's box. Nothing may have been counted
/// yet.
void TreeSearch::turn(CutSearch& search, const Box& box, int axis) {
    search.cut.axis = axis;
    search.lower = box.lower[axis];
    search.upper = std::nextafter(box.upper[axis], infinity);
}

/// Returns a search across the first axis of a node, or one that weighs the points of a part.
CutSearch TreeSearch::search_in_box(const Node& node) const {
    CutSearch search = search_across(0, {}, node.weight);
    const bool is_free = tree_.cut_axes.empty() || node.at.is_part();
    turn(search, node.box, is_free ? tree_.axes.front() : tree_.cut_axes[node.at.node]);
    return search;
}

/// Returns whether the points of a node are counted along all axes that the cut may cross.
bool TreeSearch::counts_all_axes(const Node& node) const {
    return !guide_ && tree_.cut_axes.empty() && node.search.stage == CutSearch::over_points;
}

/// Appends this rank's sums along all axes except the first.
void TreeSearch::count_other_axes(const Node& node, std::vector<double>& payload) const {
    const std::size_t num_sums = layout_.length() - HistogramLayout::num_extents;
    CutSearch search = node.search;
    for (const int axis : tree_.axes.subspan(1)) {
        turn(search, node.box, axis);
        payload.resize(payload.size() + num_sums);
        const auto sums = std::span(payload).last(num_sums);
        open_.count_sums(node.at, axis, bins_of(search, layout_), layout_, sums);
        round_weights(search.quantum, layout_, sums);
    }
}

/// Sets the bracket of a search to the extent of all points of a node. If the axis is free, takes
/// the longest axis of the points.
void TreeSearch::frame(std::span<const double> candidates, CutSearch& search) const {
    Box box;
    for (; !candidates.empty(); candidates = candidates.subspan(tree_.dimension + 1))
        for (int a = 0; a < tree_.dimension; ++a) {
            box.lower[a] = std::min(box.lower[a], candidates[a]);
            box.upper[a] = std::max(box.upper[a], candidates[a]);
        }
    const bool is_free = !guide_ && tree_.cut_axes.empty();
    turn(search, box, is_free ? longest_axis(box, tree_.axes, nearly) : search.cut.axis);
}

/// Chooses the axis of the cut and turns the search to it. Returns the histogram along this axis.
std::vector<double> TreeSearch::choose_axis(const Node& node, std::span<const double> histogram,
                                            CutSearch& search) const {
    constexpr std::size_t num_extents = HistogramLayout::num_extents;
    const std::size_t num_sums = layout_.length() - num_extents;
    const auto sums = [&](std::size_t k) {
        return histogram.subspan(num_extents + k * num_sums, num_sums);
    };
    const std::span<const int> axes = tree_.axes;
    const int longest = longest_axis(node.found, axes, nearly);
    auto best = static_cast<std::size_t>(std::ranges::find(axes, longest) - axes.begin());
    if (!tree_.crosses_longest && node.target.target > 0) {
        std::vector<StatisticalDomain> along;
        for (std::size_t k = 0; k < axes.size(); ++k) {
            turn(search, node.box, axes[k]);
            along.push_back(
                domain_of(bins_of(search, layout_), sums(k).first(layout_.num_slots())));
        }
        best = fewest_near(along, node, best, sum_of(counts_in(histogram, layout_)));
    }
    turn(search, node.box, axes[best]);
    std::vector<double> chosen(histogram.begin(), histogram.begin() + num_extents);
    chosen.insert(chosen.end(), sums(best).begin(), sums(best).end());
    return chosen;
}

/// Returns the index of the axis to cut across: `longest`, unless a cut across another axis has
/// clearly less weight near it. `along` contains the domain along each axis of a node with
/// `num_points` points.
std::size_t TreeSearch::fewest_near(std::span<const StatisticalDomain> along, const Node& node,
                                    std::size_t longest, double num_points) const {
    const auto half_extent = [&](std::size_t k) {
        return node.found.upper[tree_.axes[k]] / 2 - node.found.lower[tree_.axes[k]] / 2;
    };
    // Weight counts as near within the mean spacing of the points, but at least within one bin.
    const auto num_bins = static_cast<double>(along[longest].patches.size());
    const double spacings =
        std::clamp(std::pow(num_points, 1.0 / static_cast<double>(along.size())), 1.0, num_bins);
    const double reach = 2 * (half_extent(longest) / spacings);
    const auto near = [&](std::size_t k) {
        const Profile profile(along[k]);
        const Cut cut = weighted_quantile(profile, 0, node.target.target, true);
        return profile.weight_within(0, cut.at[0], reach);
    };
    std::size_t best = longest;
    double fewest = near(longest);
    // The fewer points are near a cut, the larger is the error of their weight.
    const double num_near = num_points * (fewest / node.weight);
    const double enough = nearly - 1 / std::sqrt(std::max(num_near, 1.0));
    for (std::size_t k = 0; k < along.size(); ++k) {
        if (k == longest || !(half_extent(k) > 0)) continue;
        const double fewer = near(k);
        if (!(fewer < enough * fewest)) continue;
        best = k;
        fewest = fewer;
    }
    return best;
}

}  // namespace rrcb
