#include "cuts/packed_tree.hpp"

#include "arithmetic/vector_clones.hpp"

#include <algorithm>

namespace rrcb {

namespace {

/// Finds the exit of each point of a block. Makes all comparisons instead of branches, which points
/// in any order would mispredict.
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

/// Moves each point of a block down one level; if `marks`, marks those on a plane.
template <bool marks>
void descend_level(const double* planes, const std::int32_t* axes, const std::int32_t* lowers,
                   const double* columns, LocalIndex length, std::int32_t* nodes,
                   std::int32_t* tied) {
    for (LocalIndex i = 0; i < length; ++i) {
        const auto node = static_cast<std::size_t>(nodes[i]);
        const double value = columns[static_cast<std::size_t>(axes[node]) * block_length + i];
        const double plane = planes[node];
        if constexpr (marks) tied[i] |= value == plane ? 1 : 0;
        nodes[i] = lowers[node] + (value >= plane ? 1 : 0);
    }
}

/// Marks all points on a plane, even beyond the region of its node.
RRCB_VECTOR_CLONES
void mark_tied(double plane, const double* x, LocalIndex length, std::int32_t* tied) {
    for (LocalIndex i = 0; i < length; ++i) tied[i] |= x[i] == plane ? 1 : 0;
}

}  // namespace

PackedTree::PackedTree(const Cuts& cuts, const Box& box) {
    pack({cuts, {}, true}, box);
}

void PackedTree::reserve(std::size_t num_parts) {
    const std::size_t num_nodes = 2 * num_parts;
    planes_.reserve(num_nodes);
    axes_.reserve(num_nodes);
    lowers_.reserve(num_nodes);
    items_.reserve(num_nodes);
    entries_.reserve(num_parts);
}

void PackedTree::pack(const Cuts& cuts, const EntryOf& entry_of) {
    pack({cuts, entry_of, false}, everywhere);
}

void PackedTree::pack(const Packing& packing, const Box& box) {
    cuts_ = packing.cuts.tree;
    dimension_ = packing.cuts.dimension;
    if (!packing.prunes) reserve(cuts_.size() + 1);
    append_node();
    add(packing, root_of(packing.cuts), box, 0, 0);
    find_top();
}

void PackedTree::append_node() {
    planes_.push_back(nowhere);
    axes_.push_back(0);
    lowers_.push_back(0);
    items_.push_back(0);
}

void PackedTree::drop_nodes(std::int32_t num_nodes) {
    planes_.resize(num_nodes);
    axes_.resize(num_nodes);
    lowers_.resize(num_nodes);
    items_.resize(num_nodes);
}

/// Fills `node` with the cuts at or below `at`, whose positions are all in `box`.
void PackedTree::add(const Packing& packing, Descent at, const Box& box, std::int32_t node,
                     int depth) {
    const Cut* cut = nullptr;
    // If cuts are pruned, skips those with the whole box on one side.
    while (!at.is_part() && (cut = find_cut(packing.cuts, at.node)) != nullptr) {
        if (!packing.prunes) break;
        const Sides sides = sides_of(box, *cut, dimension_);
        if (sides.below && sides.above) break;
        at = sides.above ? at.upper() : at.lower();
        cut = nullptr;
    }
    depth_ = std::max(depth_, depth);
    if (cut == nullptr) {
        if (!at.is_part()) return add_end(node, unknown_below(at.node));
        const Part part = at.first_part;
        return add_end(node, packing.entry_of ? packing.entry_of(part, box) : part);
    }
    const auto lower = static_cast<std::int32_t>(planes_.size());
    planes_[node] = cut->at[cut->axis];
    axes_[node] = cut->axis;
    lowers_[node] = lower;
    items_[node] = static_cast<std::int32_t>(cut - cuts_.data());
    if (!is_plane(*cut, dimension_)) is_plain_ = false;
    append_node();
    append_node();
    if (!packing.prunes && !packing.entry_of) {
        // Nothing reads the boxes.
        add(packing, at.lower(), box, lower, depth + 1);
        add(packing, at.upper(), box, lower + 1, depth + 1);
        return;
    }
    add(packing, at.lower(), box_below(box, *cut), lower, depth + 1);
    add(packing, at.upper(), box_above(box, *cut), lower + 1, depth + 1);
    if (!is_left_out(lower) || !is_left_out(lower + 1)) return;
    drop_nodes(lower);
    entries_.resize(entries_.size() - 2);
    add_end(node, left_out);
}

void PackedTree::add_end(std::int32_t node, Part entry) {
    planes_[node] = nowhere;
    axes_[node] = 0;
    lowers_[node] = node;
    items_[node] = static_cast<std::int32_t>(entries_.size());
    entries_.push_back(entry);
}

void PackedTree::find_top() {
    std::array<std::int32_t, 2 * num_top_nodes + 1> heap{};
    for (std::size_t k = 0; k < num_top_nodes; ++k) {
        const std::int32_t lower = lower_of(heap[k]);
        heap[2 * k + 1] = lower;
        heap[2 * k + 2] = is_end(heap[k]) ? lower : lower + 1;
        top_.planes[k] = planes_[heap[k]];
        top_.axes[k] = axes_[heap[k]];
    }
    for (std::size_t k = 0; k <= num_top_nodes; ++k) {
        const std::int32_t node = heap[num_top_nodes + k];
        top_.exits[k] = depth_ <= top_levels ? items_[node] : node;
    }
}

bool PackedTree::is_above_exactly(std::int32_t node, const double* position) const {
    Vector exact{};
    std::copy_n(position, dimension_, exact.begin());
    return rrcb::is_above(cuts_[items_[node]], exact, dimension_);
}

void PackedTree::find(const Columns& columns, LocalIndex length, std::int32_t* ends) const {
    const double* values = columns[0].data();
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
        descend(planes_.data(), axes_.data(), lowers_.data(), values, length, ends, tied.data());
    if (depth_ > top_levels)
        for (LocalIndex i = 0; i < length; ++i) ends[i] = items_[ends[i]];
    if (is_plain_) return;
    for_each_tied(tied, columns, length, dimension_,
                  [&](LocalIndex i, const Vector& x) { ends[i] = end_of(x.data()); });
}

}  // namespace rrcb
