#include "passes/assignment.hpp"

#include "arithmetic/non_stop.hpp"
#include "arithmetic/running_sums.hpp"
#include "arithmetic/vector_clones.hpp"
#include "cuts/packed_tree.hpp"
#include "cuts/tree.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"
#include "passes/point_layout.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace rrcb {

namespace {

/// Copies a block of points. Returns a number whose highest bit is 1 if a coordinate is not finite.
template <class Layout>
RRCB_VECTOR_CLONES std::uint64_t copy_block(const Layout& x, LocalIndex first, LocalIndex length,
                                            Columns& columns) {
    constexpr std::uint64_t magnitude = ~std::uint64_t{0} >> 1;
    constexpr std::uint64_t lowest_of_exponent = std::uint64_t{1} << 52;
    std::uint64_t carries = 0;
    for (LocalIndex i = 0; i < length; ++i) {
        for (int axis = 0; axis < Layout::dimension; ++axis) {
            const double value = x(first + i, axis);
            columns[axis][i] = value;
            // Only the largest exponent, which infinities and NaN have, carries into the sign bit.
            carries |= (std::bit_cast<std::uint64_t>(value) & magnitude) + lowest_of_exponent;
        }
    }
    return carries;
}

/// Bounds for each part along each axis. A point within the bounds of its part remains in the part
/// wherever each cut ends in its interval.
struct SettledBounds {
    /// points from here on are within the bounds
    std::array<std::vector<double>, max_dimension> least{};
    /// points below this are within the bounds
    std::array<std::vector<double>, max_dimension> beyond{};

    void add(const Cuts& cuts, std::span<const Bracket> intervals, const Descent& at,
             const Box& box) {
        if (at.is_part()) {
            for (std::size_t a = 0; a < max_dimension; ++a) {
                least[a].push_back(box.lower[a]);
                beyond[a].push_back(box.upper[a]);
            }
            return;
        }
        const int axis = cuts.tree[at.node].axis;
        const Bracket& interval = intervals[at.node];
        Box side = box;
        side.upper[axis] = std::min(box.upper[axis], interval.lower);
        add(cuts, intervals, at.lower(), side);
        side = box;
        side.lower[axis] = std::max(box.lower[axis], interval.upper);
        add(cuts, intervals, at.upper(), side);
    }
};

/// Marks the points outside the bounds of their part along one axis.
RRCB_VECTOR_CLONES void mark_open(const double* x, const double* least, const double* beyond,
                                  const Part* parts, LocalIndex length, std::int32_t* is_open) {
    for (LocalIndex i = 0; i < length; ++i)
        is_open[i] |= (x[i] < least[parts[i]] ? 1 : 0) | (x[i] >= beyond[parts[i]] ? 1 : 0);
}

/// Finds the ends of the tree for points block by block.
class Assigner {
  public:
    /// The cuts must outlive this object.
    explicit Assigner(const Cuts& cuts) : tree_(cuts) {}

    /// Gives no part to points outside the bounds of their part. If `has_parts`, points already
    /// have their parts; otherwise these are found first.
    Assigner(const Cuts& cuts, const SettledBounds& bounds, bool has_parts)
        : tree_(cuts), bounds_(&bounds), finds_(!has_parts) {}

    /// Calls visit(first, length) for each block after its `parts` are found. Returns whether all
    /// coordinates are finite; stops at the first block in which one is not.
    template <class Visit>
    bool run(const Points& points, std::span<Part> parts, Visit&& visit) {
        std::uint64_t carries = 0;
        visit_layout(points, [&](const auto& x) {
            in_ranges(points.count, block_length, [&](LocalIndex first, LocalIndex last) {
                const LocalIndex length = last - first;
                carries |= copy_block(x, first, length, columns_);
                if (carries >> 63 != 0) return;
                if (finds_) tree_.find(columns_, length, &parts[first]);
                if (bounds_ != nullptr) drop_open(points.dimension, length, &parts[first]);
                visit(first, length);
            });
        });
        return carries >> 63 == 0;
    }

    std::size_t num_ends() const { return tree_.entries().size(); }

  private:
    void drop_open(int dimension, LocalIndex length, Part* parts) {
        std::array<std::int32_t, block_length> is_open{};
        for (int a = 0; a < dimension; ++a)
            mark_open(columns_[a].data(), bounds_->least[a].data(), bounds_->beyond[a].data(),
                      parts, length, is_open.data());
        static_assert(no_part == -1);
        for (LocalIndex i = 0; i < length; ++i) parts[i] |= -is_open[i];
    }

    PackedTree tree_;
    const SettledBounds* bounds_ = nullptr;
    bool finds_ = true;
    Columns columns_{};
};

/// Counts the points of each part. Uses several counters in turn, because an increment has to wait
/// for the previous one of the same counter. Points without a part are counted separately.
class Counter {
  public:
    explicit Counter(std::size_t num_parts) : counts_(num_parts + 1) {}

    void add(std::span<const Part> parts) {
        std::size_t i = 0;
        for (; i + num_turns <= parts.size(); i += num_turns)
            for (std::size_t turn = 0; turn < num_turns; ++turn)
                ++counts_[parts[i + turn] + 1][turn];
        for (; i < parts.size(); ++i) ++counts_[parts[i] + 1][0];
    }

    std::vector<double> totals() const {
        std::vector<double> totals;
        for (const auto& turns : std::span(counts_).subspan(1))
            totals.push_back(static_cast<double>(turns[0] + turns[1] + turns[2] + turns[3]));
        return totals;
    }

  private:
    static constexpr std::size_t num_turns = 4;
    std::vector<std::array<LocalIndex, num_turns>> counts_;
};

/// Finds the ends of the tree and returns the totals of each.
EndTotals count_ends(Assigner& assigner, const Points& points, std::span<Part> parts) {
    EndTotals totals;
    Counter counter(assigner.num_ends());
    RunningSums<double> weights(assigner.num_ends() + 1);
    LocalIndex num_added = 0;
    totals.all_finite = assigner.run(points, parts, [&](LocalIndex first, LocalIndex length) {
        counter.add(parts.subspan(first, length));
        if (points.weights.empty()) return;
        for (LocalIndex i = first; i < first + length; ++i)
            weights[parts[i] + 1] += points.weights[i];
        num_added += length;
        if (num_added < weights.interval()) return;
        weights.empty();
        num_added = 0;
    });
    weights.empty();
    totals.counts = counter.totals();
    if (points.weights.empty()) {
        totals.weights = totals.counts;
    } else {
        totals.weights.assign(weights.totals().begin() + 1, weights.totals().end());
    }
    return totals;
}

}  // namespace

bool assign_ends(const Cuts& cuts, const Points& points, std::span<Part> ends) {
    if (points.count == 0) return true;
    const NonStop arithmetic;
    return Assigner(cuts).run(points, ends, [](LocalIndex, LocalIndex) {});
}

void assign(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    check_positions(points, cuts);
    require(parts.size() == points.count, "parts must have one entry per point");
    if (!locally([&] { return assign_ends(cuts, points, parts); })) reject_coordinates(points);
    number_parts(cuts, parts);
}

EndTotals assign_and_count(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    const NonStop arithmetic;
    Assigner assigner(cuts);
    return count_ends(assigner, points, parts);
}

PartTotals assign_settled(const Cuts& cuts, std::span<const Bracket> intervals,
                          const Points& points, bool has_parts, std::span<Part> parts) {
    const NonStop arithmetic;
    SettledBounds bounds;
    bounds.add(cuts, intervals, root_of(cuts), everywhere);
    Assigner assigner(cuts, bounds, has_parts);
    return count_ends(assigner, points, parts);
}

}  // namespace rrcb
