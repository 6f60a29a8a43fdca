#include "gather/kept_tree.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/position_order.hpp"
#include "bisection/limited_bisection.hpp"
#include "cuts/cut_limits.hpp"
#include "cuts/tree.hpp"
#include "options/allowed_axes.hpp"
#include "options/call_kind.hpp"

#include <rrcb/quality.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace rrcb {

namespace {

class Reader {
  public:
    Reader(std::span<const Extent> extents, const Cuts& estimate, const Options& options,
           bool by_number)
        : extents_(extents),
          estimate_(estimate),
          options_(options),
          by_number_(by_number),
          ends_(extents.size()) {
        std::iota(ends_.begin(), ends_.end(), 0);
        kept_.cuts = estimate;
        gaps_.resize(estimate.tree.size());
        kept_.parts.resize(extents.size());
        kept_.part_weights.resize(extents.size());
    }

    std::optional<KeptTree> read() {
        if (!read_node(root_of(estimate_), ends_, true)) return std::nullopt;
        if (are_cuts_limited(options_) && !move_into_places()) return std::nullopt;
        kept_.imbalance = imbalance(kept_.part_weights, options_.part_sizes);
        return std::move(kept_);
    }

  private:
    /// Reads the points of a group of ranks, named by the ends of the tree that are theirs by
    /// number, as the parts of a node. `expected`: all cuts above are across the axes of the
    /// estimate.
    bool read_node(const Descent& at, std::span<Part> ends, bool expected) {
        if (at.is_part()) return settle(at.first_part, ends.front());
        const int usual = estimate_.tree[at.node].axis;
        const int num_below = at.lower().num_parts;
        if (!has_size(at.lower()) || !has_size(at.upper())) {
            // All points belong to the parts with a size above 0.
            kept_.cuts.tree[at.node] = plane(usual, has_size(at.lower()) ? infinity : -infinity);
            return read_node(at.lower(), ends.first(num_below), expected) &&
                   read_node(at.upper(), ends.subspan(num_below), expected);
        }
        for (int k = 0; k < estimate_.dimension; ++k) {
            const auto axis = static_cast<int>(ordering_axis(usual, k));
            if (!by_number_) divide_across(axis, num_below, ends);
            const Extent below = joined(ends.first(num_below));
            const Extent above = joined(ends.subspan(num_below));
            const bool as_expected = expected && axis == usual;
            if (!may_cross(axis, usual, as_expected, below, above)) continue;
            const auto cut = cut_between(below, above, axis, estimate_.dimension,
                                         options_.axes.plain, may_divide());
            if (!cut) continue;
            if (are_cuts_limited(options_)) gaps_[at.node] = gap_between(below, above, axis);
            if (gaps_[at.node].empty()) continue;
            kept_.cuts.tree[at.node] = *cut;
            return read_node(at.lower(), ends.first(num_below), as_expected) &&
                   read_node(at.upper(), ends.subspan(num_below), as_expected);
        }
        return false;
    }

    /// Returns the positions of a cut between the points of two groups: above the last below, up to
    /// the first above.
    Places gap_between(const Extent& below, const Extent& above, int axis) const {
        const double last = below.last[axis][axis];
        const double first = above.first[axis][axis];
        const AxisLimits limits = axis_limits(options_)[axis];
        if (last == first) return {last, last};
        return {std::isinf(last) ? last : limits.place_behind(last),
                std::isinf(first) ? first : limits.place_before(std::nextafter(first, infinity))};
    }

    /// Moves the cuts to allowed positions in their gaps; returns false if these are not enough.
    bool move_into_places() {
        CutLimits limits(options_, joined(ends_).box(), estimate_.dimension,
                         {axes_of(kept_.cuts.tree), gaps_});
        if (!limits.has_room()) return false;
        rrcb::move_into_places(limits, kept_.cuts);
        return true;
    }

    bool may_cross(int axis, int usual, bool as_expected, Extent all, const Extent& above) const {
        const AxisOrder& order = options_.axes.order;
        if (order.is_given() || order.is_grouped()) return axis == usual;
        if (are_cuts_limited(options_) || !order.is_longest())
            return std::ranges::count(allowed_axes(order, estimate_.dimension), axis) > 0;
        join(all, above, estimate_.dimension);
        return as_expected || is_long(all.box(), axis, estimate_.dimension);
    }

    const Extent& extent_at(Part end) const { return extents_[part_at(estimate_, end)]; }

    /// Puts the ranks with the first points across an axis to the beginning. Coincident points are
    /// in the order of their ranks. Ranks without points stay on their side.
    void divide_across(int axis, int num_below, std::span<Part> ends) const {
        const PositionOrder is_before(axis, 0, estimate_.dimension);
        const auto has_points = [&](Part end) { return extent_at(end).count > 0; };
        std::ranges::sort(ends);
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

    Extent joined(std::span<const Part> ends) const {
        Extent all;
        for (const Part end : ends) join(all, extent_at(end), estimate_.dimension);
        return all;
    }

    /// Coincident points are in the order of their ranks, so parts in another order divide none.
    bool may_divide() const {
        return by_number_ && options_.tree.dealt == 0 &&
               options_.coincident == Coincident::divide && options_.refine != Refine::none;
    }

    bool has_size(const Descent& at) const {
        const auto sizes = std::span(options_.part_sizes).subspan(at.first_part, at.num_parts);
        return std::ranges::any_of(sizes, [](double size) { return size > 0; });
    }

    /// Gives the points of a rank their part; returns false if the part must stay empty.
    bool settle(Part part, Part end) {
        const Extent& extent = extent_at(end);
        kept_.parts[part_at(estimate_, end)] = part;
        kept_.part_weights[part] = extent.weight;
        return extent.count == 0 || options_.part_sizes[part] > 0;
    }

    std::span<const Extent> extents_;
    const Cuts& estimate_;
    const Options& options_;
    bool by_number_;
    std::vector<Part> ends_;    ///< in the order of the parts that were read
    std::vector<Places> gaps_;  ///< between the points on both sides of each cut
    KeptTree kept_;
};

}  // namespace

bool is_in_order(const KeptTree& kept) {
    for (std::size_t rank = 0; rank < kept.parts.size(); ++rank)
        if (part_at(kept.cuts, kept.parts[rank]) != static_cast<Part>(rank)) return false;
    return true;
}

bool is_long(const Box& box, int axis, int dimension) {
    constexpr double enough = 0.8;
    const auto half_extent = [&](int a) { return box.upper[a] / 2 - box.lower[a] / 2; };
    for (int other = 0; other < dimension; ++other)
        if (!(half_extent(axis) >= enough * half_extent(other))) return false;
    return true;
}

std::optional<Cut> cut_between(const Extent& below, const Extent& above, int axis, int dimension,
                               bool plain_cuts, bool may_divide) {
    if (below.count == 0) return plane(axis, -infinity);
    if (above.count == 0) return plane(axis, infinity);
    const Vector& last = below.last[axis];
    const Vector& first = above.first[axis];
    const double middle = std::midpoint(last[axis], first[axis]);
    Cut cut = plane(axis, middle > last[axis] ? middle : first[axis]);
    if (last[axis] < first[axis]) return cut;
    const PositionOrder is_before(axis, 0, dimension);
    if (plain_cuts || is_before(first, last)) return std::nullopt;
    cut.divides = is_before(last, first) ? 0 : 1;
    std::copy_n(first.begin(), dimension, cut.at.begin());
    if (cut.divides != 0 && !may_divide) return std::nullopt;
    return cut;
}

std::optional<KeptTree> read_kept_tree(std::span<const Extent> extents, const Cuts& estimate,
                                       const Options& options) {
    // By number first: an order of the ranks that divides the same boxes in another way moves
    // points.
    if (auto kept = Reader(extents, estimate, options, true).read()) return kept;
    return Reader(extents, estimate, options, false).read();
}

}  // namespace rrcb
