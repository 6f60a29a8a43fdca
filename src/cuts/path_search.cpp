#include "cuts/path_search.hpp"

#include "cuts/packed_tree.hpp"

namespace rrcb {

PathSearch::PathSearch(const Cuts& known, const Points& points, std::span<Part> parts)
    : TierSearch(known), points_(points), parts_(parts) {
    for (LocalIndex i = 0; i < parts.size(); ++i)
        if (is_unknown(parts[i])) searched_.push_back(i);
    left_ = searched_;
}

bool PathSearch::ask(Butterfly& asked) {
    std::vector<std::size_t> nodes;
    for (const LocalIndex i : left_) {
        const Descent from = node_at(cuts(), unknown_node(parts_[i])).at;
        const Descent at = descend(cuts(), points_.position(i), from);
        parts_[i] = at.is_part() ? at.first_part : unknown_below(at.node);
        if (!at.is_part() && (nodes.empty() || nodes.back() != at.node)) nodes.push_back(at.node);
    }
    std::erase_if(left_, [&](LocalIndex i) { return !is_unknown(parts_[i]); });
    TierSearch::ask(nodes, asked);
    return !left_.empty();
}

}  // namespace rrcb
