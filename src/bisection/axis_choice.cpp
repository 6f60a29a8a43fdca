#include "bisection/axis_choice.hpp"

#include "options/allowed_axes.hpp"
#include "options/axis_order.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Returns the axis of each level of the tree: the axes in the given order, each for several
/// consecutive levels. An axis gets as many levels as if every cut halved the longest extent of the
/// box.
std::vector<int> group_levels(std::span<const int> order, Box box, int dimension, int num_levels) {
    constexpr double enough = 1;
    std::array<int, max_dimension> cuts_across{};
    for (int level = 0; level < num_levels; ++level) {
        const int a = longest_axis(box, first_axes(dimension), enough);
        ++cuts_across[a];
        box.upper[a] = box.lower[a] / 2 + box.upper[a] / 2;
    }
    std::vector<int> levels;
    for (const int axis : order)
        if (axis < dimension)
            levels.insert(levels.end(), static_cast<std::size_t>(cuts_across[axis]), axis);
    return levels;
}

}  // namespace

int longest_axis(const Box& box, std::span<const int> axes, double enough) {
    const auto half_extent = [&](int axis) { return box.upper[axis] / 2 - box.lower[axis] / 2; };
    double longest = half_extent(axes.front());
    for (const int axis : axes) longest = std::max(longest, half_extent(axis));
    for (const int axis : axes)
        if (half_extent(axis) >= enough * longest) return axis;
    return axes.back();
}

AxisChoice::AxisChoice(const Options& options, const Box& box, int dimension)
    : allowed_(allowed_axes(options.expert.axes.order, dimension)) {
    const AxisOrder& order = options.expert.axes.order;
    if (is_given(order)) cut_axes_ = axes_in(order);
    if (is_grouped(order))
        level_axes_ = group_levels(axes_in(order), box, dimension,
                                   num_levels(options.expert.tree, options.num_parts));
}

std::span<const int> AxisChoice::operator()(std::size_t node, int depth) const {
    if (!cut_axes_.empty()) return std::span(cut_axes_).subspan(node, 1);
    if (!level_axes_.empty())
        return std::span(level_axes_).subspan(static_cast<std::size_t>(depth), 1);
    return allowed_;
}

std::vector<int> AxisChoice::given(const Descent& root) const {
    std::vector<int> axes = cut_axes_;
    if (axes.empty() && !level_axes_.empty()) append_given(root, 0, axes);
    return axes;
}

void AxisChoice::append_given(const Descent& at, int depth, std::vector<int>& axes) const {
    if (at.is_part()) return;
    axes.push_back(level_axes_[depth]);
    append_given(at.lower(), depth + 1, axes);
    append_given(at.upper(), depth + 1, axes);
}

}  // namespace rrcb
