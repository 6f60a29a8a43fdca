#include "zoltan/handle/last_partition.hpp"

#include <algorithm>
#include <utility>

namespace rrcb::zoltan {

void LastPartition::keep(Cuts&& cuts, PartMap&& map, Numbering&& numbering) noexcept {
    cuts_ = std::move(cuts);
    map_ = std::move(map);
    numbering_ = std::move(numbering);
}

void LastPartition::prepare_look_ups() noexcept {
    if (tree_.num_nodes() > 0) return;
    tree_.pack(cuts_, [this](Part end) { return numbering_.number_of(cuts_.part_at(end)); });
}

LastPartition LastPartition::copy() const {
    LastPartition copy(static_cast<std::size_t>(cuts_.num_parts));
    copy.keep(Cuts(cuts_), PartMap(map_), Numbering(numbering_));
    copy.answer_look_ups(answers_look_ups_);
    return copy;
}

TreeNode LastPartition::tree_node(int node) const {
    Descent at = root_of(cuts_);
    if (node == 0) return {0, 0, at.is_part() ? 0 : at.upper().first_part};
    // The number of a node is that of the first part above its cut.
    int parent = -1;
    for (Part middle = 0; (middle = at.upper().first_part) != node;) {
        at = at.towards(node);
        parent = node > middle ? -(middle + 1) : middle + 1;
    }
    const auto name = [this](const Descent& child) {
        return child.is_part() ? -cuts_.part_at(child.first_part) : child.upper().first_part;
    };
    return {parent, name(at.lower()), name(at.upper())};
}

int LastPartition::parts_touching(const Box& box, Part* parts) const {
    for (int a = 0; a < cuts_.dimension; ++a) {
        if (!(box.lower[a] <= box.upper[a])) return 0;
    }
    int count = 0;
    tree_.visit_touching(box, [&](Part part) { parts[count++] = part; });
    std::sort(parts, parts + count);
    return count;
}

}  // namespace rrcb::zoltan
