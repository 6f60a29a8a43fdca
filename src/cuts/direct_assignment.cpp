#include "cuts/direct_assignment.hpp"

#include "cells/running_sums.hpp"
#include "cuts/known_tree.hpp"
#include "cuts/point_block.hpp"
#include "cuts/tree.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace rrcb {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr int top_levels = 3;
constexpr std::size_t num_top_nodes = 7;
constexpr std::size_t num_exits = 8;

/// The tree as a heap, whose nodes 2 k + 1 and 2 k + 2 lie below and above the plane of node k.
/// Every point takes the same number of steps: below a part all nodes are that part.
struct Heap {
    std::vector<double> planes;
    std::vector<double> ties;  ///< the planes on which points are told apart by position, or NaN
    std::vector<std::int32_t> axes;
    std::vector<double> parts;  ///< of the nodes of the last level
    int depth = top_levels;
    bool is_plain = true;  ///< every cut is a plane, none breaks ties by position

    explicit Heap(const Cuts& cuts) {
        while (cuts.num_parts > 1 << depth) ++depth;
        const std::size_t num_exits_of_all = std::size_t{1} << depth;
        planes.assign(num_exits_of_all - 1, infinity);
        ties.assign(num_exits_of_all - 1, nowhere);
        axes.assign(num_exits_of_all - 1, 0);
        parts.resize(num_exits_of_all);
        fill(cuts, root_of(cuts), 0);
    }

  private:
    void fill(const Cuts& cuts, const Descent& at, std::size_t k) {
        const bool is_last = k >= planes.size();
        if (is_last) parts[k - planes.size()] = at.first_part;
        if (is_last) return;
        if (at.is_part()) {
            fill(cuts, at, 2 * k + 1);
            return fill(cuts, at, 2 * k + 2);
        }
        const Cut& cut = cuts.tree[at.node];
        planes[k] = cut.at[static_cast<std::size_t>(cut.axis)];
        axes[k] = cut.axis;
        if (!is_plane(cut, cuts.dimension)) {
            ties[k] = planes[k];
            is_plain = false;
        }
        fill(cuts, at.lower(), 2 * k + 1);
        fill(cuts, at.upper(), 2 * k + 2);
    }
};

/// The nodes of a heap below its top levels, or the parts where it is no deeper. As doubles, which
/// vectors select as fast as they compare.
std::array<double, num_exits> exits_of(const Heap& heap) {
    std::array<double, num_exits> exits;
    for (std::size_t k = 0; k < num_exits; ++k)
        exits[k] =
            heap.depth == top_levels ? heap.parts[k] : static_cast<double>(num_top_nodes + k);
    return exits;
}

/// The exit of each point of a block. All comparisons are made, so that no branch depends on a
/// point.
RRCB_VECTOR_CLONES
void descend_top(const Heap& heap, const std::array<double, num_exits>& exits,
                 const Columns& columns, LocalIndex length, std::int32_t* found) {
    const auto x = [&](std::size_t k) {
        return columns[static_cast<std::size_t>(heap.axes[k])].data();
    };
    const double *x0 = x(0), *x1 = x(1), *x2 = x(2), *x3 = x(3), *x4 = x(4), *x5 = x(5), *x6 = x(6);
    const double* p = heap.planes.data();
    const double p0 = p[0], p1 = p[1], p2 = p[2], p3 = p[3], p4 = p[4], p5 = p[5], p6 = p[6];
    const auto [e0, e1, e2, e3, e4, e5, e6, e7] = exits;
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

/// One level of the heap for each point of a block.
RRCB_VECTOR_CLONES
void descend_level(const Heap& heap, const double* columns, LocalIndex length,
                   std::int32_t* nodes) {
    const double* planes = heap.planes.data();
    const std::int32_t* axes = heap.axes.data();
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(length); ++i) {
        const std::int32_t node = nodes[i];
        const double value = columns[axes[node] * column_length + i];
        nodes[i] = 2 * node + 1 + (value >= planes[node] ? 1 : 0);
    }
}

/// The same, and marks points on a plane on which position tells points apart.
RRCB_VECTOR_CLONES
void descend_tilted_level(const Heap& heap, const double* columns, LocalIndex length,
                          std::int32_t* nodes, std::int32_t* tied) {
    const double* planes = heap.planes.data();
    const double* ties = heap.ties.data();
    const std::int32_t* axes = heap.axes.data();
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(length); ++i) {
        const std::int32_t node = nodes[i];
        const double value = columns[axes[node] * column_length + i];
        tied[i] |= value == ties[node] ? 1 : 0;
        nodes[i] = 2 * node + 1 + (value >= planes[node] ? 1 : 0);
    }
}

/// Marks the points on one such plane, wherever it ends.
RRCB_VECTOR_CLONES
void mark_tied(double tie, const double* x, LocalIndex length, std::int32_t* tied) {
    for (LocalIndex i = 0; i < length; ++i) tied[i] |= x[i] == tie ? 1 : 0;
}

/// Look-up of the parts of a block by all cuts.
class HeapLookUp {
  public:
    explicit HeapLookUp(const Cuts& cuts) : cuts_(cuts), heap_(cuts), exits_(exits_of(heap_)) {}

    std::size_t num_bins() const { return static_cast<std::size_t>(cuts_.num_parts); }

    void find(const Columns& columns, LocalIndex length, Part* parts) {
        const double* values = columns[0].data();
        descend_top(heap_, exits_, columns, length, parts);
        if (!heap_.is_plain) mark_tied_at_top(columns, length);
        for (int level = top_levels; level < heap_.depth; ++level)
            heap_.is_plain ? descend_level(heap_, values, length, parts)
                           : descend_tilted_level(heap_, values, length, parts, tied_.data());
        if (heap_.depth > top_levels) {
            const std::size_t first = heap_.planes.size();
            for (LocalIndex i = 0; i < length; ++i)
                parts[i] =
                    static_cast<Part>(heap_.parts[static_cast<std::size_t>(parts[i]) - first]);
        }
        if (heap_.is_plain) return;
        for_each_tied(tied_, columns, length, cuts_.dimension, [&](LocalIndex i, const Vector& x) {
            parts[i] = descend(cuts_, x, root_of(cuts_)).first_part;
        });
    }

    /// Bins are parts.
    void write_parts(std::span<Part>) const {}
    std::vector<Part> parts_of_bins() const { return {}; }

  private:
    void mark_tied_at_top(const Columns& columns, LocalIndex length) {
        tied_.fill(0);
        for (std::size_t k = 0; k < num_top_nodes; ++k)
            if (!std::isnan(heap_.ties[k]))
                mark_tied(heap_.ties[k], columns[static_cast<std::size_t>(heap_.axes[k])].data(),
                          length, tied_.data());
    }

    const Cuts& cuts_;
    Heap heap_;
    std::array<double, num_exits> exits_;
    TiedPoints tied_{};
};

/// Finds the parts of points block by block.
template <class LookUp>
class Assigner {
  public:
    explicit Assigner(LookUp&& look_up) : look_up_(std::move(look_up)) {}

    /// Calls `visit(first, length)` after each block whose bins were written in place of its parts.
    /// Returns whether all coordinates are finite.
    template <class Visit>
    bool run(const Points& points, std::span<Part> parts, Visit&& visit) {
        std::uint64_t carries = 0;
        visit_layout(points, [&](const auto& x) {
            in_ranges(points.count, block_length, [&](LocalIndex first, LocalIndex last) {
                const LocalIndex length = last - first;
                carries |= copy_block(x, first, length, columns_);
                look_up_.find(columns_, length, &parts[first]);
                visit(first, length);
                look_up_.write_parts(parts.subspan(first, length));
            });
        });
        return carries >> 63 == 0;
    }

    const LookUp& look_up() const { return look_up_; }

  private:
    LookUp look_up_;
    Columns columns_{};
};

/// Counts in turns, as a number is read again no sooner than it was written.
class Counter {
  public:
    explicit Counter(std::size_t num_parts) : counts_(num_parts) {}

    void add(std::span<const Part> parts) {
        std::size_t i = 0;
        for (; i + num_turns <= parts.size(); i += num_turns)
            for (std::size_t turn = 0; turn < num_turns; ++turn)
                ++counts_[static_cast<std::size_t>(parts[i + turn])][turn];
        for (; i < parts.size(); ++i) ++counts_[static_cast<std::size_t>(parts[i])][0];
    }

    std::vector<double> totals() const {
        std::vector<double> totals;
        for (const auto& turns : counts_)
            totals.push_back(static_cast<double>(turns[0] + turns[1] + turns[2] + turns[3]));
        return totals;
    }

  private:
    static constexpr std::size_t num_turns = 4;
    std::vector<std::array<LocalIndex, num_turns>> counts_;
};

/// See assign_and_count().
template <class LookUp>
PartTotals count_by(LookUp&& look_up, const Points& points, std::span<Part> parts) {
    const std::size_t num_bins = look_up.num_bins();
    PartTotals totals;
    Counter counter(num_bins);
    RunningSums<double> weights(num_bins);
    LocalIndex num_added = 0;
    Assigner assigner(std::move(look_up));
    totals.all_finite = assigner.run(points, parts, [&](LocalIndex first, LocalIndex length) {
        counter.add(parts.subspan(first, length));
        if (points.weights.empty()) return;
        for (LocalIndex i = first; i < first + length; ++i)
            weights[static_cast<std::size_t>(parts[i])] += points.weights[i];
        num_added += length;
        if (num_added < weights.interval()) return;
        weights.empty();
        num_added = 0;
    });
    weights.empty();
    totals.counts = counter.totals();
    totals.weights = points.weights.empty() ? totals.counts : weights.totals();
    totals.parts = assigner.look_up().parts_of_bins();
    return totals;
}

/// Box of points, without bounds where one is not finite.
Box box_around(const Points& points) {
    Box box = bounding_box(points);
    for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a)
        if (!(box.lower[a] <= box.upper[a])) {
            box.lower.fill(-infinity);
            box.upper.fill(infinity);
        }
    return box;
}

}  // namespace

bool assign_known(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    if (points.count == 0) return true;
    const auto look_at_nothing = [](LocalIndex, LocalIndex) {};
    return is_whole(cuts)
               ? Assigner(HeapLookUp(cuts)).run(points, parts, look_at_nothing)
               : Assigner(KnownTree(cuts, box_around(points))).run(points, parts, look_at_nothing);
}

void assign(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    check_positions(points, cuts);
    require(parts.size() == points.count, "parts must have one entry per point");
    if (!assign_known(cuts, points, parts)) reject_coordinates(points);
    if (!is_whole(cuts) && std::ranges::any_of(parts, is_unknown)) reject_unknown();
}

PartTotals assign_and_count(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    return is_whole(cuts) ? count_by(HeapLookUp(cuts), points, parts)
                          : count_by(KnownTree(cuts, box_around(points)), points, parts);
}

}  // namespace rrcb
