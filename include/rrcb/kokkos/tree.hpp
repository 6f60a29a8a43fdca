#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/kokkos/points.hpp>
#include <rrcb/kokkos/sums.hpp>
#include <rrcb/method/bisection.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::detail {

/// A cut in the memory of a device: 32 bytes. The cuts below it follow, then those above.
struct TreeNode {
    double at[max_dimension];
    std::int32_t axis;
    std::int32_t lower_parts;  ///< parts below it

    /// Returns true if a position is not below the cut, as is_above() of the host.
    KOKKOS_INLINE_FUNCTION bool is_above(const Position& p, int dimension) const {
        const double x = axis == 0 ? p.x[0] : axis == 1 ? p.x[1] : p.x[2];
        const double plane = axis == 0 ? at[0] : axis == 1 ? at[1] : at[2];
        if (x != plane) return x > plane;
        for (int a = 0; a < max_dimension; ++a)
            if (a < dimension && p.x[a] != at[a]) return p.x[a] > at[a];
        return true;
    }
};

/// The positions lower <= x < upper: by default all.
struct Region {
    double lower[max_dimension] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double upper[max_dimension] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};

    KOKKOS_INLINE_FUNCTION bool contains(const Position& p, int dimension) const {
        for (int a = 0; a < max_dimension; ++a)
            if (a < dimension && !(p.x[a] >= lower[a] && p.x[a] < upper[a])) return false;
        return true;
    }
};

/// A tree of cuts for a device.
struct PackedCuts {
    std::vector<TreeNode> nodes{};
    std::vector<Region> regions{};  ///< of each part: whose points no cut leaves to another part

    PackedCuts() = default;
    /// Packs complete cuts; without intervals they are fixed.
    PackedCuts(const Cuts& cuts, std::span<const Bracket> intervals) {
        add(cuts, intervals, 0, cuts.num_parts, {});
    }

  private:
    void add(const Cuts& cuts, std::span<const Bracket> intervals, std::size_t node, int num_parts,
             const Region& region) {
        if (num_parts == 1) return regions.push_back(region);
        const Cut& cut = cuts.tree[node];
        const int lower_parts = cuts.shape.lower_parts(num_parts);
        nodes.push_back({{cut.at[0], cut.at[1], cut.at[2]}, cut.axis, lower_parts});
        Region below = region;
        Region above = region;
        if (!intervals.empty()) {
            double& upper = below.upper[cut.axis];
            double& lower = above.lower[cut.axis];
            upper = std::min(upper, intervals[node].lower);
            lower = std::max(lower, intervals[node].upper);
        }
        add(cuts, intervals, node + 1, lower_parts, below);
        add(cuts, intervals, node + static_cast<std::size_t>(lower_parts), num_parts - lower_parts,
            above);
    }
};

/// Points that become open, by the region of their part.
enum class Opens { none, outside, inside };

/// Returns the mark of open points of a part until they are copied, or the part of a mark.
KOKKOS_INLINE_FUNCTION Part marked(Part part) {
    return no_part - 1 - part;
}

/// Finds the parts of points, or takes those that are given; marks the open points, and counts the
/// others.
template <class T, class W>
struct Assign {
    Positions<T> x;
    Weights<W> weights;
    const TreeNode* nodes;
    const Region* regions;
    Part* parts;
    int num_parts;
    bool finds;
    Opens opens;
    bool counts;

    // Bins: coordinates that are not finite, open points; counts of parts, then their weights.
    static constexpr int bad = 0;
    static constexpr int open = 1;
    static constexpr int first = 2;

    std::int64_t num_bins() const {
        return first + (counts ? num_parts : 0) * (weights.values == nullptr ? 1 : 2);
    }
    template <class Bins>
    KOKKOS_INLINE_FUNCTION void operator()(std::int64_t i, const Bins& bins) const {
        const Position p = x.position(i);
        for (int a = 0; a < max_dimension; ++a)
            if (!is_finite(p.x[a])) bins.add(bad, 1);
        const Part part = finds ? part_of(p) : parts[i];
        const bool is_open = opens != Opens::none && part >= 0 &&
                             regions[part].contains(p, x.dimension) == (opens == Opens::inside);
        parts[i] = is_open ? marked(part) : part;
        if (is_open) return bins.add(open, 1);
        if (!counts || part < 0) return;
        bins.add(first + part, 1);
        if (weights.values != nullptr) bins.add(first + num_parts + part, weights.units(i));
    }
    KOKKOS_INLINE_FUNCTION Part part_of(const Position& p) const {
        std::int32_t node = 0;
        Part part = 0;
        for (int below = num_parts; below > 1;) {
            const std::int32_t lower_parts = nodes[node].lower_parts;
            const bool is_above = nodes[node].is_above(p, x.dimension);
            node += is_above ? lower_parts : 1;
            part += is_above ? lower_parts : 0;
            below = is_above ? below - lower_parts : lower_parts;
        }
        return part;
    }
};

}  // namespace rrcb::detail
