#include "parallel/ghost_nodes_mpi.hpp"

#include <algorithm>

namespace mpm {

namespace {

/// Stands for a node that the patch lacks.
constexpr auto not_here = static_cast<rrcb::LocalIndex>(-1);

/// Returns whether points reach a node. Fields can have values where weights are 0.
template <int D>
bool is_reached(const GridPatch<D>& patch, std::size_t n) {
    return patch.sums[n].mass > 0 ||
           std::ranges::any_of(patch.fields, [&](const auto& field) { return field[n] != 0; });
}

template <int D>
bool contains(const NodeRange<D>& range, const std::array<int, D>& node) {
    for (std::size_t a = 0; a < D; ++a)
        if (node[a] < range.begin[a] || node[a] >= range.begin[a] + range.count[a]) return false;
    return true;
}

}  // namespace

template <int D>
GhostNodes<D>::GhostNodes(std::span<const NodeRange<D>> ranges, int rank) {
    const NodeRange<D>& mine = ranges[static_cast<std::size_t>(rank)];
    for (int other = 0; other < static_cast<int>(ranges.size()); ++other) {
        const NodeRange<D> both = intersection<D>(mine, ranges[static_cast<std::size_t>(other)]);
        if (other == rank || both.empty()) continue;
        ranks_.push_back(other);
        ranges_.push_back(both);
    }
}

template <int D>
void GhostNodes<D>::number(const GridPatch<D>& patch) {
    shared_ = {};
    common_.clear();
    for (std::size_t k = 0; k < ranks_.size(); ++k) {
        const std::size_t begin = shared_.indices.size();
        visit_nodes<D>(ranges_[k], [&](const std::array<int, D>& node) {
            const bool is_mine = contains<D>(patch.nodes, node);
            shared_.indices.push_back(is_mine ? patch.index(node) : not_here);
            if (is_mine) common_.push_back(shared_.indices.back());
        });
        shared_.ranks.push_back({ranks_[k], shared_.indices.size() - begin});
    }
    std::ranges::sort(common_);
    common_.erase(std::unique(common_.begin(), common_.end()), common_.end());
}

template <int D>
std::span<double> GhostNodes<D>::sums_of(GridPatch<D>& patch) {
    constexpr std::size_t width = 1 + 2 * D;
    static_assert(sizeof(NodeSums<D>) == width * sizeof(double));
    num_shared_ = static_cast<std::size_t>(
        std::ranges::count_if(common_, [&](std::size_t n) { return is_reached(patch, n); }));
    return {reinterpret_cast<double*>(patch.sums.data()), width * patch.sums.size()};
}

template class GhostNodes<2>;
template class GhostNodes<3>;

}  // namespace mpm
