#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/kokkos/sums.hpp>
#include <rrcb/method/bisection.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace rrcb::detail {

/// A cut in the memory of a device: 40 bytes.
struct TreeNode {
    double plane;                    ///< along the axis of the cut
    double ties[max_dimension - 1];  ///< along the other axes, ascending
    std::int32_t axis;               ///< of the cut
    std::int32_t lower;              ///< node below the cut; ~part if there is one part
    std::int32_t upper;              ///< likewise above
};

/// A tree of cuts that a kernel descends.
struct Tree {
    const TreeNode* nodes;
    std::int32_t root;
    int dimension;

    /// Returns the part of a position, as is_above() at each cut.
    KOKKOS_INLINE_FUNCTION Part part_of(const Position& p) const {
        std::int32_t at = root;
        while (at >= 0) {
            const TreeNode& node = nodes[at];
            const double x = node.axis == 0 ? p.x[0] : node.axis == 1 ? p.x[1] : p.x[2];
            bool is_above = x > node.plane;
            if (x == node.plane) is_above = is_tie_above(node, p);
            at = is_above ? node.upper : node.lower;
        }
        return ~at;
    }
    KOKKOS_INLINE_FUNCTION bool is_tie_above(const TreeNode& node, const Position& p) const {
        int k = 0;
        for (int a = 0; a < max_dimension; ++a) {
            if (a == node.axis || a >= dimension) continue;
            const double tie = node.ties[k++];
            if (p.x[a] != tie) return p.x[a] > tie;
        }
        return true;
    }
};

/// Node on the way down a tree on the host.
struct TreePlace {
    std::size_t node;
    Part first_end;
    int num_parts;
};

inline TreePlace below(const Cuts& cuts, const TreePlace& at) {
    return {at.node + 1, at.first_end, cuts.shape.lower_parts(at.num_parts)};
}
inline TreePlace above(const Cuts& cuts, const TreePlace& at) {
    const int lower = cuts.shape.lower_parts(at.num_parts);
    return {at.node + static_cast<std::size_t>(lower), at.first_end + lower, at.num_parts - lower};
}

/// Packs the cuts at or below `at`; returns the number of their root. Ends are numbers of the tree,
/// or parts.
inline std::int32_t pack(const Cuts& cuts, const TreePlace& at, bool has_parts,
                         std::vector<TreeNode>& nodes) {
    if (at.num_parts == 1)
        return ~(has_parts ? cuts.shape.part_at(at.first_end, cuts.num_parts) : at.first_end);
    const Cut& cut = cuts.tree[at.node];
    TreeNode node{cut.at[static_cast<std::size_t>(cut.axis)], {}, cut.axis, 0, 0};
    int k = 0;
    for (int a = 0; a < max_dimension; ++a)
        if (a != cut.axis) node.ties[k++] = cut.at[static_cast<std::size_t>(a)];
    node.lower = pack(cuts, below(cuts, at), has_parts, nodes);
    node.upper = pack(cuts, above(cuts, at), has_parts, nodes);
    nodes[at.node] = node;
    return static_cast<std::int32_t>(at.node);
}

/// Bounds of the points that no cut leaves to another part.
struct SettledBox {
    double least[max_dimension];   ///< points at them are settled
    double beyond[max_dimension];  ///< points below them are

    KOKKOS_INLINE_FUNCTION bool contains(const Position& p, int dimension) const {
        for (int a = 0; a < max_dimension; ++a)
            if (a < dimension && (p.x[a] < least[a] || p.x[a] >= beyond[a])) return false;
        return true;
    }
};

/// Appends the bounds of the parts at or below `at`, in their order.
inline void add_bounds(const Cuts& cuts, std::span<const Bracket> intervals, const TreePlace& at,
                       const SettledBox& box, std::vector<SettledBox>& bounds) {
    if (at.num_parts == 1) return bounds.push_back(box);
    const int axis = cuts.tree[at.node].axis;
    const Bracket& interval = intervals[at.node];
    SettledBox side = box;
    side.beyond[axis] = std::min(box.beyond[axis], interval.lower);
    add_bounds(cuts, intervals, below(cuts, at), side, bounds);
    side = box;
    side.least[axis] = std::max(box.least[axis], interval.upper);
    add_bounds(cuts, intervals, above(cuts, at), side, bounds);
}

inline std::vector<SettledBox> settled_bounds(const Cuts& cuts,
                                              std::span<const Bracket> intervals) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<SettledBox> bounds;
    SettledBox all{};
    std::fill_n(all.least, max_dimension, -infinity);
    std::fill_n(all.beyond, max_dimension, infinity);
    add_bounds(cuts, intervals, {0, 0, cuts.num_parts}, all, bounds);
    return bounds;
}

/// A tree of cuts and its memory on a device.
template <class Memory>
class DeviceTree {
  public:
    /// Copies whole cuts. Ends are parts if `has_parts`, else numbers of the tree.
    template <class Execution>
    DeviceTree(const Execution& exec, const Cuts& cuts, bool has_parts)
        : nodes_(cuts.tree.size()), tree_{nullptr, 0, cuts.dimension} {
        tree_.root = pack(cuts, {0, 0, cuts.num_parts}, has_parts, nodes_);
        view_ = copy_in<Memory>(exec, std::span<const TreeNode>(nodes_));
        tree_.nodes = view_.data();
    }
    const Tree& get() const { return tree_; }

  private:
    std::vector<TreeNode> nodes_;
    Kokkos::View<TreeNode*, Memory> view_{};
    Tree tree_;
};

/// Gives each point its part, and counts.
template <class T, class W>
struct AssignBody {
    Positions<T> x;
    Weights<W> weights;
    Tree tree;
    const SettledBox* bounds;  ///< null: every part is settled
    Part* parts;
    int num_parts;
    bool finds;   ///< the parts; otherwise they are given
    bool counts;  ///< in bins: the number of each part and of no_part, then likewise weights
    Faults* faults;

    template <class Bins>
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, const Bins& bins) const {
        const Position p = x.position(i);
        for (int a = 0; a < max_dimension; ++a)
            if (!is_finite(p.x[a])) faults->add(i, a);
        Part part = finds ? tree.part_of(p) : parts[i];
        if (bounds != nullptr && part >= 0 && !bounds[part].contains(p, x.dimension))
            part = no_part;
        parts[i] = part;
        if (!counts) return;
        const std::int64_t bin = part < 0 ? num_parts : part;
        bins.add(bin, 1);
        if (weights.values != nullptr) bins.add(bin + num_parts + 1, weights.units(i));
    }
};

/// Runs an assignment; returns its bins, none if it does not count. Throws Error for coordinates
/// that are not finite. A fence.
template <class Memory, class Execution, class T, class W>
std::vector<double> assigned(const Execution& exec, AssignBody<T, W> body) {
    static_assert(sizeof(Faults) == 2 * sizeof(Word));
    const std::int64_t fields = body.weights.values == nullptr ? 1 : 2;
    std::array<Word, 2> faults{};
    std::vector<double> bins =
        sum_in_bins<Memory>(exec, body.x.count, body.counts ? fields * (body.num_parts + 1) : 0,
                            faults, [&](Word* extra) {
                                body.faults = reinterpret_cast<Faults*>(extra);
                                return body;
                            });
    check_coordinates({faults[0], faults[1]});
    return bins;
}

}  // namespace rrcb::detail
