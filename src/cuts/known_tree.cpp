#include "cuts/known_tree.hpp"

#include <algorithm>
#include <limits>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One level of the tree for each point of a block.
RRCB_VECTOR_CLONES
void descend_level(const double* planes, const std::int32_t* axes, const std::int32_t* children,
                   const double* columns, LocalIndex length, std::int32_t* nodes) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(length); ++i) {
        const std::int32_t node = nodes[i];
        const double value = columns[axes[node] * column_length + i];
        nodes[i] = children[2 * node + (value >= planes[node] ? 1 : 0)];
    }
}

/// Marks points on a plane on which position tells points apart.
RRCB_VECTOR_CLONES
void mark_tied(const double* ties, const std::int32_t* axes, const double* columns,
               LocalIndex length, const std::int32_t* nodes, std::int32_t* tied) {
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(length); ++i) {
        const std::int32_t node = nodes[i];
        tied[i] |= columns[axes[node] * column_length + i] == ties[node] ? 1 : 0;
    }
}

}  // namespace

std::int32_t KnownTree::add(double plane, std::int32_t axis, const Cut* cut) {
    const auto node = static_cast<std::int32_t>(planes_.size());
    const bool is_tilted = cut != nullptr && !is_plane(*cut, cuts_.dimension);
    planes_.push_back(plane);
    ties_.push_back(is_tilted ? plane : nowhere);
    axes_.push_back(axis);
    children_.insert(children_.end(), {node, node});
    nodes_.push_back(cut);
    bins_.push_back(0);
    if (is_tilted) is_plain_ = false;
    return node;
}

/// Adds what divides the box below `at`; returns the first node of it.
std::int32_t KnownTree::link(Descent at, const Box& box, int depth) {
    const Cut* cut = nullptr;
    while (!at.is_part() && (cut = find_cut(cuts_, at.node)) != nullptr) {
        const Sides sides = sides_of(box, *cut, cuts_.dimension);
        if (sides.below && sides.above) break;
        at = sides.above ? at.upper() : at.lower();
        cut = nullptr;
    }
    if (cut == nullptr) {
        const std::int32_t node = add(infinity, 0, nullptr);
        bins_.back() = static_cast<std::int32_t>(exits_.size());
        exits_.push_back(at.is_part() ? at.first_part : unknown_below(at.node));
        depth_ = std::max(depth_, depth);
        return node;
    }
    const auto axis = static_cast<std::size_t>(cut->axis);
    const std::int32_t node = add(cut->at[axis], cut->axis, cut);
    Box below = box;
    Box above = box;
    below.upper[axis] = std::min(box.upper[axis], cut->at[axis]);
    above.lower[axis] = std::max(box.lower[axis], cut->at[axis]);
    const std::int32_t lower = link(at.lower(), below, depth + 1);
    const std::int32_t upper = link(at.upper(), above, depth + 1);
    const auto first = 2 * static_cast<std::size_t>(node);
    children_[first] = lower;
    children_[first + 1] = upper;
    return node;
}

std::int32_t KnownTree::exit_of(const Vector& position) const {
    std::size_t node = 0;
    while (nodes_[node] != nullptr) {
        const bool above = is_above(*nodes_[node], position, cuts_.dimension);
        node = static_cast<std::size_t>(children_[2 * node + (above ? 1 : 0)]);
    }
    return bins_[node];
}

void KnownTree::find(const Columns& columns, LocalIndex length, std::int32_t* bins) {
    const double* values = columns[0].data();
    std::fill_n(bins, length, 0);
    if (!is_plain_) tied_.fill(0);
    for (int level = 0; level < depth_; ++level) {
        if (!is_plain_) mark_tied(ties_.data(), axes_.data(), values, length, bins, tied_.data());
        descend_level(planes_.data(), axes_.data(), children_.data(), values, length, bins);
    }
    for (LocalIndex i = 0; i < length; ++i) bins[i] = bins_[static_cast<std::size_t>(bins[i])];
    if (is_plain_) return;
    for_each_tied(tied_, columns, length, cuts_.dimension,
                  [&](LocalIndex i, const Vector& x) { bins[i] = exit_of(x); });
}

void KnownTree::write_parts(std::span<Part> bins) const {
    for (Part& bin : bins) bin = exits_[static_cast<std::size_t>(bin)];
}

}  // namespace rrcb
