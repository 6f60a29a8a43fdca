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
    KOKKOS_INLINE_FUNCTION bool is_above(const double (&p)[Dimension]) const {
        double x = p[0];
        double plane = at[0];
        for (int a = 1; a < Dimension; ++a)
            if (axis == a) x = p[a], plane = at[a];
        if (x != plane) return x > plane;
        for (int a = 0; a < Dimension; ++a)
            if (p[a] != at[a]) return p[a] > at[a];
        return true;
    }
};

/// The positions with lower <= x < upper; by default all positions.
struct Region {
    double lower[max_dimension] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double upper[max_dimension] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};

    template <int Dimension>
    KOKKOS_INLINE_FUNCTION bool contains(const double (&p)[Dimension]) const {
        for (int a = 0; a < Dimension; ++a)
            if (!(p[a] >= lower[a] && p[a] < upper[a])) return false;
        return true;
    }
};

/// A tree of cuts for a device.
struct PackedCuts {
    std::vector<TreeNode> nodes{};
    std::vector<Region> regions{};  ///< for each part, the region whose points remain in the part
                                    ///< wherever each cut ends in its interval

    /// Adds the cuts of a complete tree below a node with `num_parts` parts in `region`.
    void add(const Cuts& cuts, std::span<const Bracket> intervals, int num_parts,
             const Region& region) {
        if (num_parts == 1) return regions.push_back(region);
        const Cut& cut = cuts.tree[nodes.size()];
        const Bracket& interval = intervals[nodes.size()];
        const int lower_parts = cuts.shape.lower_parts(num_parts);
        nodes.push_back({{cut.at[0], cut.at[1], cut.at[2]}, cut.axis, lower_parts});
        Region below = region;
        Region above = region;
        below.upper[cut.axis] = std::min(region.upper[cut.axis], interval.lower);
        above.lower[cut.axis] = std::max(region.lower[cut.axis], interval.upper);
        add(cuts, intervals, lower_parts, below);
        add(cuts, intervals, num_parts - lower_parts, above);
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
    static constexpr int dimension = Positions::dimension;
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
        double p[dimension];
        bool is_bad = false;
        for (int a = 0; a < dimension; ++a) {
            p[a] = x(i, a);
            is_bad = is_bad || !is_finite(p[a]);
        }
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
    KOKKOS_INLINE_FUNCTION Part part_of(const double (&p)[dimension]) const {
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
    constexpr int dimension = Positions::dimension;
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
    constexpr int dimension = Positions::dimension;
    constexpr int width = 2 * dimension;
    std::vector<Box> boxes(static_cast<std::size_t>(num_parts));
    // For each part, the least coordinates and then the least negated coordinates.
    const std::vector<std::int64_t> none(width * boxes.size(),
                                         std::bit_cast<std::int64_t>(HUGE_VAL));
    const auto bounds = device.copy_in(none);
    Kokkos::parallel_for(
        "rrcb::boxes", device.range(x.count), KOKKOS_LAMBDA(const std::int64_t i) {
            if (parts[i] < 0) return;
            std::int64_t* const least = bounds.data() + parts[i] * width;
            volatile const std::int64_t* const before = least;
            for (int k = 0; k < width; ++k) {
                const double value = k < dimension ? x(i, k) : -x(i, k - dimension);
                std::int64_t place = 0;
                memcpy(&place, &value, sizeof place);
                // For most points these tests save the atomic operation.
                if (in_order(place) < before[k])
                    Kokkos::atomic_fetch_min(least + k, in_order(place));
            }
        });
    const std::vector<std::int64_t> found = device.copy_out(bounds);
    const auto bound = [&](std::size_t k) { return std::bit_cast<double>(in_order(found[k])); };
    for (std::size_t p = 0; p < boxes.size(); ++p)
        for (std::size_t a = 0; a < dimension; ++a) {
            boxes[p].lower[a] = bound(width * p + a);
            boxes[p].upper[a] = -bound(width * p + dimension + a);
        }
    return boxes;
}

}  // namespace rrcb::detail
