#pragma once

#include "cuts/owned_cuts.hpp"
#include "cuts/packed_tree.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>

namespace rrcb {

/// Finds the parts whose closed region a ball touches, but for some that are left out. A region
/// that holds no position is touched by none.
class BallSearch {
  public:
    /// Leaves out the parts in `ranges`, which ascend; the radius is finite, 0 or more. `cuts`
    /// outlives the search.
    BallSearch(const Cuts& cuts, double radius, std::span<const PartRange> ranges)
        : dimension_(cuts.dimension),
          reach_(std::min(radius * (1 + 4 * epsilon), std::numeric_limits<double>::max())),
          unit_(reach_ > 0 ? reach_ : 1),
          tree_(cuts, [&](Part part, const Box& region) {
              return is_in(ranges, part) || is_region_empty(cuts, part, region) ? left_out : part;
          }) {}

    /// Calls visit(part), and lack(node) where the cut of a node is not known; both ascend. In time
    /// as there are such parts times the depth of the tree.
    template <class Visit, class Lack>
    void for_each_part(const Vector& centre, Visit&& visit, Lack&& lack) const {
        descend(0, centre, {}, visit, lack);
    }

    /// True when the ball is in the interior of a box.
    bool is_inside(const Vector& centre, const Box& box) const {
        for (int a = 0; a < dimension_; ++a)
            if (!(centre[a] - box.lower[a] > reach_ && box.upper[a] - centre[a] > reach_))
                return false;
        return true;
    }

  private:
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

    static bool is_in(std::span<const PartRange> ranges, Part part) {
        const auto next = std::ranges::upper_bound(ranges, part, {}, &PartRange::first);
        return next != ranges.begin() && part < std::prev(next)->end;
    }

    bool is_near(const Vector& apart) const {
        double square = 0;
        for (int a = 0; a < dimension_; ++a) {
            if (apart[a] > reach_) return false;
            if (apart[a] > 0) square += (apart[a] / unit_) * (apart[a] / unit_);
        }
        return square <= 1 + 8 * epsilon;
    }

    /// Each entry of `apart` is the distance of the centre, along that axis, to the region of the
    /// node.
    template <class Visit, class Lack>
    void descend(std::int32_t node, const Vector& centre, const Vector& apart, Visit&& visit,
                 Lack&& lack) const {
        if (!is_near(apart)) return;
        if (tree_.is_end(node)) {
            const Part entry = tree_.entry_at(node);
            if (entry == left_out) return;
            return is_unknown(entry) ? lack(unknown_node(entry)) : visit(entry);
        }
        const int axis = tree_.axis_of(node);
        const double plane = tree_.plane_of(node);
        Vector below = apart;
        Vector above = apart;
        below[axis] = std::max(apart[axis], centre[axis] - plane);
        above[axis] = std::max(apart[axis], plane - centre[axis]);
        descend(tree_.lower_of(node), centre, below, visit, lack);
        descend(tree_.lower_of(node) + 1, centre, above, visit, lack);
    }

    int dimension_;
    double reach_;  ///< the radius, and what rounding may add to a distance
    double unit_;   ///< of lengths, so that their squares do not overflow
    PackedTree tree_;
};

}  // namespace rrcb
