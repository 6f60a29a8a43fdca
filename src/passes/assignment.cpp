#include "passes/assignment.hpp"

#include "arithmetic/non_stop.hpp"
#include "arithmetic/running_sums.hpp"
#include "arithmetic/vector_clones.hpp"
#include "cuts/packed_tree.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"
#include "passes/point_layout.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace rrcb {

namespace {

/// Copies a block of points; returns a number whose highest bit is 1 if a coordinate is not finite.
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
            // Only the largest exponent, that of infinities and NaN, carries into the sign.
            carries |= (std::bit_cast<std::uint64_t>(value) & magnitude) + lowest_of_exponent;
        }
    }
    return carries;
}

/// Returns the box of points, without bounds if a coordinate is not finite.
Box box_around(const Points& points) {
    const Box box = bounding_box(points);
    for (int a = 0; a < points.dimension; ++a)
        if (!(box.lower[a] <= box.upper[a])) return everywhere;
    return box;
}

/// Finds the parts of points block by block. Bins are the ends of the tree.
class Assigner {
  public:
    /// `cuts` outlive it.
    Assigner(const Cuts& cuts, const Points& points)
        : tree_(is_whole(cuts) ? PackedTree(cuts) : PackedTree(cuts, box_around(points))),
          bins_are_parts_(is_whole(cuts)) {}

    /// Calls `visit(first, length)` for each block while `parts` holds its bins. Returns whether
    /// all coordinates are finite; stops at the first block in which one is not.
    template <class Visit>
    bool run(const Points& points, std::span<Part> parts, Visit&& visit) {
        std::uint64_t carries = 0;
        visit_layout(points, [&](const auto& x) {
            in_ranges(points.count, block_length, [&](LocalIndex first, LocalIndex last) {
                const LocalIndex length = last - first;
                carries |= copy_block(x, first, length, columns_);
                if (carries >> 63 != 0) return;
                tree_.find(columns_, length, &parts[first]);
                visit(first, length);
                if (bins_are_parts_) return;
                for (Part& bin : parts.subspan(first, length)) bin = tree_.entries()[bin];
            });
        });
        return carries >> 63 == 0;
    }

    const std::vector<Part>& parts_of_bins() const { return tree_.entries(); }

  private:
    PackedTree tree_;
    bool bins_are_parts_;
    Columns columns_{};
};

/// Counts in turns, as an increment waits for the last one of the same number.
class Counter {
  public:
    explicit Counter(std::size_t num_parts) : counts_(num_parts) {}

    void add(std::span<const Part> parts) {
        std::size_t i = 0;
        for (; i + num_turns <= parts.size(); i += num_turns)
            for (std::size_t turn = 0; turn < num_turns; ++turn) ++counts_[parts[i + turn]][turn];
        for (; i < parts.size(); ++i) ++counts_[parts[i]][0];
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

}  // namespace

bool assign_known(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    if (points.count == 0) return true;
    const NonStop arithmetic;
    return Assigner(cuts, points).run(points, parts, [](LocalIndex, LocalIndex) {});
}

void assign(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    check_positions(points, cuts);
    require(parts.size() == points.count, "parts must have one entry per point");
    if (!locally([&] { return assign_known(cuts, points, parts); })) reject_coordinates(points);
    if (!is_whole(cuts) && std::ranges::any_of(parts, is_unknown)) reject_unknown();
    number_parts(cuts, parts);
}

PartTotals assign_and_count(const Cuts& cuts, const Points& points, std::span<Part> parts) {
    const NonStop arithmetic;
    Assigner assigner(cuts, points);
    const std::size_t num_bins = assigner.parts_of_bins().size();
    PartTotals totals;
    Counter counter(num_bins);
    RunningSums<double> weights(num_bins);
    LocalIndex num_added = 0;
    totals.all_finite = assigner.run(points, parts, [&](LocalIndex first, LocalIndex length) {
        counter.add(parts.subspan(first, length));
        if (points.weights.empty()) return;
        for (LocalIndex i = first; i < first + length; ++i) weights[parts[i]] += points.weights[i];
        num_added += length;
        if (num_added < weights.interval()) return;
        weights.empty();
        num_added = 0;
    });
    weights.empty();
    totals.counts = counter.totals();
    totals.weights = points.weights.empty() ? totals.counts : weights.totals();
    if (!is_whole(cuts)) totals.parts = assigner.parts_of_bins();
    return totals;
}

}  // namespace rrcb
