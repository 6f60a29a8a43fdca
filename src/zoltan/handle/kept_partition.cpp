#include "zoltan/handle/kept_partition.hpp"

#include "cuts/tree.hpp"

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

KeptPartition::KeptPartition(std::size_t num_parts, bool are_spread) {
    nodes_.reserve(are_spread ? 0 : num_parts);
}

void KeptPartition::keep(Cuts&& cuts, PartMap&& map, Numbering&& numbering) noexcept {
    cuts_ = std::move(cuts);
    map_ = std::move(map);
    numbering_ = std::move(numbering);
    if (is_whole(cuts_)) root_ = build(0, cuts_.num_parts);
}

void KeptPartition::show_all(std::vector<Cut>&& tree) noexcept {
    all_ = std::move(tree);
}

void KeptPartition::keep_shared() {
    if (shared_.empty()) return;
    all_.assign(shared_.begin(), shared_.end());
    shared_ = {};
}

std::span<const Cut> KeptPartition::tree() const {
    if (is_whole(cuts_)) return cuts_.tree;
    return all_.empty() ? shared_ : std::span<const Cut>(all_);
}

/// Builds the nodes of a subtree in preorder. Returns its first one as a child.
std::int32_t KeptPartition::build(Part first_part, int num_parts) {
    if (num_parts == 1) return ~numbering_.number_of(first_part);
    const auto index = nodes_.size();
    const Cut& cut = cuts_.tree[index];
    nodes_.push_back({cut.at[static_cast<std::size_t>(cut.axis)], cut.axis, {}});
    const int below = lower_parts(num_parts);
    const std::int32_t lower = build(first_part, below);
    const std::int32_t upper = build(first_part + below, num_parts - below);
    nodes_[index].child = {lower, upper};
    return static_cast<std::int32_t>(index);
}

TreeNode KeptPartition::tree_node(int node) const {
    Descent at = root_of(cuts_);
    if (node == 0) return {0, 0, at.is_part() ? 0 : at.upper().first_part};
    // A node has the number of the first part above its cut.
    int parent = -1;
    for (Part middle = 0; (middle = at.upper().first_part) != node;) {
        at = node > middle ? at.upper() : at.lower();
        parent = node > middle ? -(middle + 1) : middle + 1;
    }
    const auto name = [](const Descent& child) {
        return child.is_part() ? -child.first_part : child.upper().first_part;
    };
    return {parent, name(at.lower()), name(at.upper())};
}

bool KeptPartition::is_above(std::size_t cut, const double* position) const {
    const Node& node = nodes_[cut];
    const double x = position[node.axis];
    if (x != node.plane) [[likely]]
        return x > node.plane;
    Vector exact{};
    std::copy_n(position, cuts_.dimension, exact.begin());
    return rrcb::is_above(cuts_.tree[cut], exact, cuts_.dimension);
}

/// Descends all cuts, where the kept ones are spread over the ranks.
Part KeptPartition::descend_spread(const double* position) const {
    Vector exact{};
    std::copy_n(position, cuts_.dimension, exact.begin());
    Descent at = root_of(cuts_);
    const std::span<const Cut> all = tree();
    while (!at.is_part())
        at = rrcb::is_above(all[at.node], exact, cuts_.dimension) ? at.upper() : at.lower();
    return numbering_.number_of(at.first_part);
}

Part KeptPartition::part_of(const double* position) const {
    if (!is_whole(cuts_)) [[unlikely]]
        return descend_spread(position);
    std::int32_t at = root_;
    while (at >= 0) {
        const auto cut = static_cast<std::size_t>(at);
        // An index in place of a branch, which unordered positions would make unpredictable.
        at = nodes_[cut].child[is_above(cut, position) ? 1 : 0];
    }
    return ~at;
}

int KeptPartition::parts_touching(const Box& box, Part* parts) const {
    for (std::size_t a = 0; a < static_cast<std::size_t>(cuts_.dimension); ++a) {
        if (!(box.lower[a] <= box.upper[a])) return 0;
    }
    int count = 0;
    if (is_whole(cuts_)) [[likely]] {
        count = collect(root_, box, parts, 0);
    } else {
        visit_touching(
            root_of(cuts_), box, cuts_.dimension,
            [all = tree()](const Descent& at) -> const Cut& { return all[at.node]; },
            [&](Part part) { parts[count++] = numbering_.number_of(part); });
    }
    std::sort(parts, parts + count);
    return count;
}

int KeptPartition::collect(std::int32_t at, const Box& box, Part* parts, int count) const {
    if (at < 0) {
        parts[count] = ~at;
        return count + 1;
    }
    const auto cut = static_cast<std::size_t>(at);
    const bool below = !is_above(cut, box.lower.data()) ||
                       holds_divided_points(box, cuts_.tree[cut], cuts_.dimension);
    if (below) count = collect(nodes_[cut].child[0], box, parts, count);
    if (is_above(cut, box.upper.data())) count = collect(nodes_[cut].child[1], box, parts, count);
    return count;
}

Box KeptPartition::region_of(Part part) const {
    return region_below(root_of(cuts_), numbering_.box_of(part),
                        [all = tree()](const Descent& at) -> const Cut& { return all[at.node]; });
}

}  // namespace rrcb::zoltan
