#include "estimate/kept_tree.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/middle.hpp"
#include "arithmetic/position_order.hpp"
#include "cuts/tree.hpp"
#include "estimate/cell_records.hpp"
#include "options/allowed_axes.hpp"
#include "options/axis_order.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace rrcb {

namespace {

/// Returns the cut in the middle between two positions: `last` is below it, `first` above.
Cut cut_between_positions(const Vector& last, const Vector& first, int axis, int dimension) {
    Cut cut = plane(axis, first[axis]);
    for (int k = 0; k < dimension; ++k) {
        const std::size_t a = ordering_axis(axis, k);
        cut.at[a] = first[a];
        if (last[a] == first[a]) continue;
        cut.at[a] = middle_of(last[a], first[a]);
        break;
    }
    return cut;
}

class Reader {
  public:
    Reader(std::span<const PointSummary> extents, const Cuts& estimate, const Options& options)
        : extents_(extents), estimate_(estimate), options_(options) {
        kept_.cuts = estimate;
        kept_.parts.resize(extents.size());
        kept_.part_weights.resize(extents.size());
    }

    std::optional<KeptTree> read() {
        std::vector<Part> ends(extents_.size());
        std::iota(ends.begin(), ends.end(), 0);
        if (!read_node(root_of(estimate_), ends, true)) return std::nullopt;
        kept_.imbalance = imbalance(kept_.part_weights, options_.part_sizes);
        return std::move(kept_);
    }

  private:
    /// Reads the points of a group of ranks as the parts of a node. `ends` are the ends of the tree
    /// whose parts have the numbers of these ranks. `expected` means that all cuts above are across
    /// the axes of the estimate. Returns false if the points are not a bisection.
    bool read_node(const Descent& at, std::span<Part> ends, bool expected) {
        if (at.is_part()) return settle(at.first_part, ends.front());
        const int usual = estimate_.tree[at.node].axis;
        const int num_below = at.lower().num_parts;
        if (!has_size(at.lower()) || !has_size(at.upper())) {
            // One side has only parts of size 0, so all points belong to the other side.
            kept_.cuts.tree[at.node] = plane(usual, has_size(at.lower()) ? infinity : -infinity);
            return read_node(at.lower(), ends.first(num_below), expected) &&
                   read_node(at.upper(), ends.subspan(num_below), expected);
        }
        // Divides the ranks by number first: if only their order differs, points would move
        // although the boxes are the same.
        for (const bool by_number : {true, false}) {
            for (int k = 0; k < estimate_.dimension; ++k) {
                const auto axis = static_cast<int>(ordering_axis(usual, k));
                const bool as_expected = expected && axis == usual;
                if (!cut_across(axis, at, as_expected, by_number, ends)) continue;
                return read_node(at.lower(), ends.first(num_below), as_expected) &&
                       read_node(at.upper(), ends.subspan(num_below), as_expected);
            }
        }
        return false;
    }

    /// Cuts a node across an axis between two groups of ranks, divided by number or by position.
    /// Returns false if no cut is allowed.
    bool cut_across(int axis, const Descent& at, bool as_expected, bool by_number,
                    std::span<Part> ends) {
        const int num_below = at.lower().num_parts;
        std::ranges::sort(ends);
        if (!by_number) divide_across(axis, num_below, ends);
        if (!may_cross(axis, estimate_.tree[at.node].axis, as_expected, joined(ends))) return false;
        const auto cut = cut_between(joined(ends.first(num_below)), joined(ends.subspan(num_below)),
                                     axis, by_number);
        if (cut) kept_.cuts.tree[at.node] = *cut;
        return cut.has_value();
    }

    /// Returns true if a cut through these points may be across an axis.
    bool may_cross(int axis, int usual, bool as_expected, const PointSummary& all) const {
        const AxisOrder& order = options_.expert.axes.order;
        if (is_given(order) || is_grouped(order)) return axis == usual;
        if (!is_longest(order))
            return std::ranges::count(allowed_axes(order, estimate_.dimension), axis) > 0;
        if (as_expected) return true;
        // This is less strict than for a new cut, whose extents are estimated. Otherwise cuts might
        // turn in every call.
        constexpr double enough = 0.8;
        const auto half_extent = [&](int a) { return all.last[a][a] / 2 - all.first[a][a] / 2; };
        for (int other = 0; other < estimate_.dimension; ++other)
            if (!(half_extent(axis) >= enough * half_extent(other))) return false;
        return true;
    }

    /// Returns the cut between two groups of ranks, in the middle of the gap between them if there
    /// is one; nullopt if no cut is allowed. If the cut divides coincident points, those of lower
    /// ranks are below.
    std::optional<Cut> cut_between(const PointSummary& below, const PointSummary& above, int axis,
                                   bool by_number) const {
        if (below.count == 0) return plane(axis, -infinity);
        if (above.count == 0) return plane(axis, infinity);
        const Vector& last = below.last[axis];
        const Vector& first = above.first[axis];
        const PositionOrder is_before(axis, 0,
                                      options_.expert.axes.plain ? 1 : estimate_.dimension);
        if (is_before(last, first))
            return cut_between_positions(last, first, axis, estimate_.dimension);
        if (options_.expert.axes.plain || is_before(first, last)) return std::nullopt;
        Cut cut = plane(axis, first[axis]);
        cut.divides = 1;
        std::copy_n(first.begin(), estimate_.dimension, cut.at.begin());
        const bool may_divide = by_number && estimate_.is_numbered_in_order() &&
                                options_.expert.coincident == Coincident::divide &&
                                options_.refine != Refine::none;
        if (!may_divide) return std::nullopt;
        return cut;
    }

    const PointSummary& extent_at(Part end) const { return extents_[estimate_.part_at(end)]; }

    /// Reorders sorted ends so that the ranks whose points come first across an axis are at the
    /// beginning. Coincident points are ordered by rank. Ranks without points remain on their side.
    void divide_across(int axis, int num_below, std::span<Part> ends) const {
        const PositionOrder is_before(axis, 0, estimate_.dimension);
        const auto has_points = [&](Part end) { return extent_at(end).count > 0; };
        std::vector<Part> filled;
        std::ranges::copy_if(ends, std::back_inserter(filled), has_points);
        const auto middle =
            filled.begin() + std::ranges::count_if(ends.first(num_below), has_points);
        std::ranges::nth_element(filled, middle, [&](Part i, Part j) {
            const Vector& one = extent_at(i).first[axis];
            const Vector& other = extent_at(j).first[axis];
            return is_before(one, other) || (!is_before(other, one) && i < j);
        });
        auto next = filled.begin();
        for (Part& end : ends)
            if (has_points(end)) end = *next++;
    }

    PointSummary joined(std::span<const Part> ends) const {
        PointSummary all;
        for (const Part end : ends) join(all, extent_at(end), estimate_.dimension);
        return all;
    }

    bool has_size(const Descent& at) const {
        const auto sizes = std::span(options_.part_sizes).subspan(at.first_part, at.num_parts);
        return std::ranges::any_of(sizes, [](double size) { return size > 0; });
    }

    /// Gives the points of a rank their part. Returns false if the part must be empty but is not.
    bool settle(Part part, Part end) {
        const PointSummary& extent = extent_at(end);
        kept_.parts[estimate_.part_at(end)] = part;
        kept_.part_weights[part] = extent.weight;
        return extent.count == 0 || options_.part_sizes[part] > 0;
    }

    std::span<const PointSummary> extents_;
    const Cuts& estimate_;
    const Options& options_;
    KeptTree kept_;
};

}  // namespace

void join(PointSummary& extent, const PointSummary& other, int dimension) {
    extent.count += other.count;
    extent.weight += other.weight;
    for (int a = 0; a < dimension; ++a) {
        const PositionOrder is_before(a, 0, dimension);
        extent.first[a] = std::min(extent.first[a], other.first[a], is_before);
        extent.last[a] = std::max(extent.last[a], other.last[a], is_before);
    }
}

void append_extent(const PointSummary& extent, int dimension, std::vector<double>& doubles) {
    doubles.insert(doubles.end(), {static_cast<double>(extent.count), extent.weight});
    for (const auto& ends : {extent.first, extent.last})
        for (int a = 0; a < dimension; ++a) append_vector(ends[a], dimension, doubles);
}

std::vector<PointSummary> read_extents(std::span<const double> doubles, int dimension) {
    std::vector<PointSummary> extents;
    while (!doubles.empty()) {
        PointSummary& extent = extents.emplace_back();
        const auto totals = take(doubles, 2);
        extent.count = static_cast<LocalIndex>(totals[0]);
        extent.weight = totals[1];
        for (auto* ends : {&extent.first, &extent.last})
            for (int a = 0; a < dimension; ++a) (*ends)[a] = take_vector(doubles, dimension);
    }
    return extents;
}

bool is_in_order(const Cuts& cuts, std::span<const Part> parts) {
    for (std::size_t rank = 0; rank < parts.size(); ++rank)
        if (cuts.part_at(parts[rank]) != static_cast<Part>(rank)) return false;
    return true;
}

std::optional<KeptTree> read_kept_tree(std::span<const PointSummary> extents, const Cuts& estimate,
                                       const Options& options) {
    return Reader(extents, estimate, options).read();
}

}  // namespace rrcb
