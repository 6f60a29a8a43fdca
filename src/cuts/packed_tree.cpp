#include "cuts/packed_tree.hpp"

#include "arithmetic/vector_clones.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Finds the exit of each point of a block. Makes all comparisons, because branches would be
/// mispredicted for points in any order.
RRCB_VECTOR_CLONES
void descend_top(const PackedTree::Top& top, const Columns& columns, LocalIndex length,
                 std::int32_t* found) {
    const auto x = [&](std::size_t k) { return columns[top.axes[k]].data(); };
    const double *x0 = x(0), *x1 = x(1), *x2 = x(2), *x3 = x(3), *x4 = x(4), *x5 = x(5), *x6 = x(6);
    const auto [p0, p1, p2, p3, p4, p5, p6] = top.planes;
    const auto [e0, e1, e2, e3, e4, e5, e6, e7] = top.exits;
    for (LocalIndex i = 0; i < length; ++i) {
        const double pair0 = x3[i] >= p3 ? e1 : e0;
        const double pair1 = x4[i] >= p4 ? e3 : e2;
        const double pair2 = x5[i] >= p5 ? e5 : e4;
        const double pair3 = x6[i] >= p6 ? e7 : e6;
        const double below = x1[i] >= p1 ? pair1 : pair0;
        const double above = x2[i] >= p2 ? pair3 : pair2;
        found[i] = static_cast<std::int32_t>(x0[i] >= p0 ? above : below);
    }
}

/// 1 for each point of a block that is exactly on a cut, so that its other coordinates decide;
/// otherwise 0.
using TiedPoints = std::array<std::int32_t, block_length>;

/// Moves each point of a block down by one level. If `marks`, marks the points exactly on a cut.
template <bool marks>
void descend_level(const PackedTree::Node* nodes, const Columns& columns, LocalIndex length,
                   std::int32_t* at, TiedPoints& tied) {
    const double* const values = columns[0].data();
    for (LocalIndex i = 0; i < length; ++i) {
        const PackedTree::Node& node = nodes[at[i]];
        const double value = values[static_cast<std::size_t>(node.axis) * block_length + i];
        if constexpr (marks) tied[i] |= value == node.plane ? 1 : 0;
        at[i] = node.lower + (value >= node.plane ? 1 : 0);
    }
}

/// Marks all points exactly on a plane, even those outside the region of its node.
RRCB_VECTOR_CLONES
void mark_tied(double plane, const double* x, LocalIndex length, std::int32_t* tied) {
    for (LocalIndex i = 0; i < length; ++i) tied[i] |= x[i] == plane ? 1 : 0;
}

}  // namespace

void PackedTree::reserve(std::size_t num_parts) {
    nodes_.reserve(2 * num_parts);
    entries_.reserve(num_parts);
}

void PackedTree::pack(const Cuts& cuts, const EntryOf& entry_of) {
    cuts_ = cuts.tree;
    dimension_ = cuts.dimension;
    reserve(cuts_.size() + 1);
    nodes_.emplace_back();
    add(root_of(cuts), entry_of, 0, 0);
    find_top();
}

/// Fills `node` and its descendants with the cuts at and below `at`.
void PackedTree::add(const Descent& at, const EntryOf& entry_of, std::int32_t node, int depth) {
    depth_ = std::max(depth_, depth);
    if (at.is_part()) {
        nodes_[node] = {nowhere, 0, node, static_cast<std::int32_t>(entries_.size())};
        entries_.push_back(entry_of ? entry_of(at.first_part) : at.first_part);
        return;
    }
    const Cut& cut = cuts_[at.node];
    const std::int32_t lower = num_nodes();
    nodes_[node] = {cut.at[cut.axis], cut.axis, lower, static_cast<std::int32_t>(at.node)};
    if (!is_plane(cut, dimension_)) is_plain_ = false;
    nodes_.resize(nodes_.size() + 2);
    add(at.lower(), entry_of, lower, depth + 1);
    add(at.upper(), entry_of, lower + 1, depth + 1);
}

void PackedTree::find_top() {
    std::array<std::int32_t, 2 * num_top_nodes + 1> heap{};
    for (std::size_t k = 0; k < num_top_nodes; ++k) {
        const std::int32_t lower = lower_of(heap[k]);
        heap[2 * k + 1] = lower;
        heap[2 * k + 2] = is_end(heap[k]) ? lower : lower + 1;
        top_.planes[k] = plane_of(heap[k]);
        top_.axes[k] = axis_of(heap[k]);
    }
    for (std::size_t k = 0; k <= num_top_nodes; ++k) {
        const std::int32_t node = heap[num_top_nodes + k];
        top_.exits[k] = depth_ <= top_levels ? nodes_[node].item : node;
    }
}

bool PackedTree::is_above_exactly(std::int32_t node, const double* position) const {
    Vector exact{};
    std::copy_n(position, dimension_, exact.begin());
    return rrcb::is_above(cuts_[nodes_[node].item], exact, dimension_);
}

void PackedTree::find(const Columns& columns, LocalIndex length, std::int32_t* ends) const {
    TiedPoints tied;
    descend_top(top_, columns, length, ends);
    if (!is_plain_) {
        tied.fill(0);
        for (std::size_t k = 0; k < num_top_nodes; ++k)
            if (top_.planes[k] != nowhere)
                mark_tied(top_.planes[k], columns[top_.axes[k]].data(), length, tied.data());
    }
    const auto descend = is_plain_ ? descend_level<false> : descend_level<true>;
    for (int level = top_levels; level < depth_; ++level)
        descend(nodes_.data(), columns, length, ends, tied);
    if (depth_ > top_levels)
        for (LocalIndex i = 0; i < length; ++i) ends[i] = nodes_[ends[i]].item;
    if (is_plain_) return;
    for (LocalIndex i = 0; i < length; ++i)
        if (tied[i] != 0)
            ends[i] = end_of(Vector{columns[0][i], columns[1][i], columns[2][i]}.data());
}

}  // namespace rrcb
