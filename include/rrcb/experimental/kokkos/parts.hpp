#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/detail/passes.hpp>
#include <rrcb/experimental/kokkos/points.hpp>
#include <rrcb/experimental/kokkos/sums.hpp>

#include <bit>
#include <cstring>

namespace rrcb::detail {

/// A cut in the memory of a device, 32 bytes long. The cuts below it follow, and then those above
/// it.
struct TreeNode {
    double at[max_dimension];
    std::int32_t axis;
    std::int32_t lower_parts;  ///< number of parts below it

    /// Returns true if a position is above the cut or at it, as is_above() on the host.
    template <int Dimension>
    KOKKOS_INLINE_FUNCTION bool is_above(const Position<Dimension>& p) const {
        double x = p.x[0];
        double plane = at[0];
        for (int a = 1; a < Dimension; ++a)
            if (axis == a) x = p.x[a], plane = at[a];
        if (x != plane) return x > plane;
        for (int a = 0; a < Dimension; ++a)
            if (p.x[a] != at[a]) return p.x[a] > at[a];
        return true;
    }
};

/// The positions with lower <= x < upper; by default all positions.
struct Region {
    double lower[max_dimension] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double upper[max_dimension] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};

    template <int Dimension>
    KOKKOS_INLINE_FUNCTION bool contains(const Position<Dimension>& p) const {
        for (int a = 0; a < Dimension; ++a)
            if (!(p.x[a] >= lower[a] && p.x[a] < upper[a])) return false;
        return true;
    }
};

/// A tree of cuts for a device.
struct PackedCuts {
    std::vector<TreeNode> nodes{};
    std::vector<Region> regions{};  ///< for each part, the region whose points remain in the part
                                    ///< wherever each cut ends in its interval

    PackedCuts() = default;
    /// Packs a complete tree. Without intervals the cuts are final.
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

/// Which points become open, depending on the region of their part.
enum class Opens { none, outside, inside };

/// Returns the mark of a part, which is negative. Open points have it in place of their part until
/// they are copied. Applied to a mark, it returns the part.
KOKKOS_INLINE_FUNCTION Part marked(Part part) {
    return no_part - 1 - part;
}

/// Finds the parts of points, or takes given ones. Marks the open points, and counts the others.
template <class Positions, class W, bool Weighs>
struct Assign {
    static constexpr int fields = Weighs ? 2 : 1;  ///< the number of points, and their weight
    // Bins of the rows: points with coordinates that are not finite, open points, then the points
    // of each part.
    static constexpr int bad = 0;
    static constexpr int open = 1;
    static constexpr int first = 2;

    Positions x;
    Weights<W> weights;
    const TreeNode* nodes;
    const Region* regions;
    Part* parts;
    int num_parts;
    bool finds;
    Opens opens;
    bool counts;

    std::int64_t num_bins() const { return fields * (first + (counts ? num_parts : 0)); }

    KOKKOS_INLINE_FUNCTION Row<fields> operator()(std::int64_t i) const {
        const auto p = x.position(i);
        bool is_bad = false;
        for (const double value : p.x) is_bad = is_bad || !is_finite(value);
        const Part part = finds ? part_of(p) : parts[i];
        const bool is_open = opens != Opens::none && part >= 0 &&
                             regions[part].contains(p) == (opens == Opens::inside);
        if (finds || is_open) parts[i] = is_open ? marked(part) : part;
        if (is_bad) return {bad, {1}};
        if (is_open) return {fields * open, {1}};
        if (!counts || part < 0) return {Row<fields>::none, {}};
        Row<fields> row{static_cast<std::int64_t>(fields) * (first + part), {1}};
        if (Weighs) row.values[fields - 1] = weights.units(i);
        return row;
    }
    template <class Position>
    KOKKOS_INLINE_FUNCTION Part part_of(const Position& p) const {
        std::int32_t node = 0;
        Part part = 0;
        for (int below = num_parts; below > 1;) {
            const std::int32_t lower_parts = nodes[node].lower_parts;
            const bool is_above = nodes[node].is_above(p);
            node += is_above ? lower_parts : 1;
            part += is_above ? lower_parts : 0;
            below = is_above ? below - lower_parts : lower_parts;
        }
        return part;
    }
};

/// Appends points to those on the host, but not to their totals. If `parts` are given, replaces
/// their marks by no_part. Returns the parts that the points had. Ends with a fence.
template <bool Weighs, class Device, class Positions, class W>
std::vector<Part> copy_points(Device& device, const Positions& x, const Weights<W>& weights,
                              const typename Device::template Lent<LocalIndex>& indices,
                              Part* parts, Collected& to) {
    constexpr int dimension = Positions::static_dimension;
    constexpr int width = dimension + (Weighs ? 3 : 2);
    const auto view =
        device.template lend<double>(indices.extent(0) * static_cast<std::size_t>(width));
    Kokkos::parallel_for(
        "rrcb::copy", device.range(indices.extent(0)), KOKKOS_LAMBDA(const std::int64_t k) {
            const auto i = static_cast<std::int64_t>(indices(k));
            double* row = view.data() + k * width;
            *row++ = static_cast<double>(i);
            *row++ = parts == nullptr ? no_part : marked(parts[i]);
            if (parts != nullptr) parts[i] = no_part;
            for (int a = 0; a < dimension; ++a) *row++ = x(i, a);
            if (Weighs) *row = weights(i);
        });
    const std::vector<double> rows = device.copy_out(view);
    std::vector<Part> before;
    to.dimension = dimension;
    for (auto row = rows.begin(); row != rows.end(); row += width) {
        to.original.push_back(static_cast<LocalIndex>(row[0]));
        before.push_back(static_cast<Part>(row[1]));
        to.coordinates.insert(to.coordinates.end(), row + 2, row + 2 + dimension);
        if (Weighs) to.weights.push_back(row[width - 1]);
    }
    return before;
}

/// Lists the marked points in ascending order of their indices. There are `number` of them.
template <class Device>
typename Device::template Lent<LocalIndex> list_marked(Device& device, std::size_t count,
                                                       std::size_t number, const Part* parts) {
    const auto indices = device.template lend<LocalIndex>(number);
    const auto lock = lock_scratch<typename Device::Execution>();
    Kokkos::parallel_scan(
        "rrcb::list", device.range(count),
        KOKKOS_LAMBDA(const std::int64_t i, std::int64_t& before, const bool is_final) {
            if (parts[i] >= no_part) return;
            if (is_final) indices(before) = static_cast<LocalIndex>(i);
            ++before;
        });
    return indices;
}

/// Converts a double's bits to an integer in the same order, and back. Devices have atomic minima
/// only of integers.
KOKKOS_INLINE_FUNCTION std::int64_t in_order(std::int64_t bits) {
    return bits < 0 ? bits ^ INT64_MAX : bits;
}

/// Returns the box of the points of each part. Ends with a fence.
template <class Device, class Positions>
std::vector<Box> boxes_of_parts(Device& device, const Positions& x, const Part* parts,
                                int num_parts) {
    constexpr std::size_t dimension = Positions::static_dimension;
    using Bounds = std::array<std::int64_t, 2 * dimension>;  // of coordinates, then of negated ones
    Bounds none;
    none.fill(std::bit_cast<std::int64_t>(HUGE_VAL));
    const std::vector<Bounds> empty(static_cast<std::size_t>(num_parts), none);
    const auto bounds = device.copy_in(empty);
    Kokkos::parallel_for(
        "rrcb::boxes", device.range(x.count), KOKKOS_LAMBDA(const std::int64_t i) {
            if (parts[i] < 0) return;
            auto* const least = reinterpret_cast<std::int64_t*>(bounds.data() + parts[i]);
            volatile const std::int64_t* const before = least;
            for (std::size_t k = 0; k < 2 * dimension; ++k) {
                const double value = x(i, static_cast<int>(k % dimension));
                const double bound = k < dimension ? value : -value;
                std::int64_t place = 0;
                memcpy(&place, &bound, sizeof place);
                // For most points these tests save the atomic operation.
                if (in_order(place) < before[k])
                    Kokkos::atomic_fetch_min(least + k, in_order(place));
            }
        });
    std::vector<Box> boxes(static_cast<std::size_t>(num_parts));
    const std::vector<Bounds> found = device.copy_out(bounds);
    for (std::size_t p = 0; p < found.size(); ++p)
        for (std::size_t a = 0; a < dimension; ++a) {
            boxes[p].lower[a] = std::bit_cast<double>(in_order(found[p][a]));
            boxes[p].upper[a] = -std::bit_cast<double>(in_order(found[p][dimension + a]));
        }
    return boxes;
}

}  // namespace rrcb::detail
