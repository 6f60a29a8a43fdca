#include "zoltan/handle/kept_partition.hpp"

#include "cuts/tree.hpp"

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

KeptPartition::KeptPartition(std::size_t num_parts) : boxes_(num_parts), tree_(num_parts) {
    nodes_.reserve(num_parts);
}

void KeptPartition::keep(Cuts&& cuts, const Frame& frame, PartMap&& map,
                         std::vector<Part>&& numbers) noexcept {
    cuts_ = std::move(cuts);
    frame_ = frame;
    map_ = std::move(map);
    numbers_ = std::move(numbers);
    for (std::size_t box = 0; box < numbers_.size(); ++box)
        boxes_[static_cast<std::size_t>(numbers_[box])] = static_cast<Part>(box);
    root_ = build(0, cuts_.num_parts, -1);
    if (cuts_.num_parts > 1) tree_[0].upper = lower_parts(cuts_.num_parts);
}

/// Builds the nodes of a subtree in preorder. Returns its first one as a child. `parent` as in
/// TreeNode.
std::int32_t KeptPartition::build(Part first_part, int num_parts, int parent) {
    if (num_parts == 1) return ~numbers_[static_cast<std::size_t>(first_part)];
    const auto index = nodes_.size();
    const Cut& cut = cuts_.tree[index];
    nodes_.push_back({cut.at[static_cast<std::size_t>(cut.axis)], cut.axis, {}});
    // A node has the number of the first part above its cut.
    const int below = lower_parts(num_parts);
    const int above = num_parts - below;
    const Part middle = first_part + below;
    const auto name = [](Part start, int size) {
        return size == 1 ? -start : start + lower_parts(size);
    };
    tree_[static_cast<std::size_t>(middle)] = {parent, name(first_part, below),
                                               name(middle, above)};
    const std::int32_t lower = build(first_part, below, middle + 1);
    const std::int32_t upper = build(middle, above, -(middle + 1));
    nodes_[index].child = {lower, upper};
    return static_cast<std::int32_t>(index);
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

Part KeptPartition::part_of(const double* coordinates) const {
    if (!frame_.turns()) [[likely]]
        return descend(coordinates);
    return descend(place(frame_, coordinates).data());
}

Part KeptPartition::descend(const double* position) const {
    std::int32_t at = root_;
    while (at >= 0) {
        const auto cut = static_cast<std::size_t>(at);
        // An index in place of a branch, which unordered positions would make unpredictable.
        at = nodes_[cut].child[is_above(cut, position) ? 1 : 0];
    }
    return ~at;
}

int KeptPartition::parts_touching(const Box& box, Part* parts) const {
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension()); ++a) {
        if (!(box.lower[a] <= box.upper[a])) return 0;
    }
    const int count = collect(root_, frame_.turns() ? place(frame_, box) : box, parts, 0);
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
    return unshifted(frame_, box_of(cuts_, boxes_[static_cast<std::size_t>(part)]));
}

}  // namespace rrcb::zoltan
