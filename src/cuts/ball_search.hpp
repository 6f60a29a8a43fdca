#pragma once

#include "cuts/owned_cuts.hpp"
#include "cuts/packed_tree.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>

namespace rrcb {

/// The points within a radius, finite and 0 or more, of a centre.
class Ball {
  public:
    Ball(const Vector& centre, double radius)
        : centre_(centre),
          reach_(std::min(radius * (1 + 4 * epsilon), std::numeric_limits<double>::max())),
          unit_(reach_ > 0 ? reach_ : 1) {}

    /// Returns true if the ball is in the interior of a box.
    bool is_inside(const Box& box, int dimension) const {
        for (int a = 0; a < dimension; ++a)
            if (!(centre_[a] - box.lower[a] > reach_ && box.upper[a] - centre_[a] > reach_))
                return false;
        return true;
    }

    /// Returns true if the ball touches a region at these distances from the centre along the axes.
    bool touches(const Vector& apart, int dimension) const {
        double square = 0;
        for (int a = 0; a < dimension; ++a) {
            if (apart[a] > reach_) return false;
            if (apart[a] > 0) square += (apart[a] / unit_) * (apart[a] / unit_);
        }
        return square <= 1 + 8 * epsilon;
    }

    bool reaches(double distance) const { return distance <= reach_; }

    const Vector& centre() const { return centre_; }

    Ball moved_to(const Vector& centre) const {
        Ball ball = *this;
        ball.centre_ = centre;
        return ball;
    }

  private:
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

    Vector centre_;
    double reach_;  ///< the radius, plus the rounding errors of a distance
    double unit_;   ///< of lengths, so that their squares do not overflow
};

/// Finds the parts whose closed region a ball touches, except some. An empty region is never
/// touched.
class BallSearch {
  public:
    /// Leaves out the parts in `ranges`, which ascend. `cuts` outlives the search.
    BallSearch(const Cuts& cuts, std::span<const PartRange> ranges)
        : dimension_(cuts.dimension), tree_(cuts, [&](Part part, const Box& region) {
              return is_in(ranges, part) || is_region_empty(cuts, part, region) ? left_out : part;
          }) {}

    /// Calls visit(part), and lack(node) for nodes whose cut is unknown, both ascending. Time:
    /// these calls times the depth of the tree. `apart` are the distances from the centre to the
    /// box that limits all regions.
    template <class Visit, class Lack>
    void for_each_part(const Ball& ball, Visit&& visit, Lack&& lack,
                       const Vector& apart = {}) const {
        descend(0, ball, apart, visit, lack);
    }

  private:
    static bool is_in(std::span<const PartRange> ranges, Part part) {
        const auto next = std::ranges::upper_bound(ranges, part, {}, &PartRange::first);
        return next != ranges.begin() && part < std::prev(next)->end;
    }

    /// `apart` are the distances from the centre to the region of the node along the axes.
    template <class Visit, class Lack>
    void descend(std::int32_t node, const Ball& ball, const Vector& apart, Visit&& visit,
                 Lack&& lack) const {
        if (!ball.touches(apart, dimension_)) return;
        if (tree_.is_end(node)) {
            const Part entry = tree_.entry_at(node);
            if (entry == left_out) return;
            return is_unknown(entry) ? lack(unknown_node(entry)) : visit(entry);
        }
        const int axis = tree_.axis_of(node);
        const double plane = tree_.plane_of(node);
        Vector below = apart;
        Vector above = apart;
        below[axis] = std::max(apart[axis], ball.centre()[axis] - plane);
        above[axis] = std::max(apart[axis], plane - ball.centre()[axis]);
        descend(tree_.lower_of(node), ball, below, visit, lack);
        descend(tree_.lower_of(node) + 1, ball, above, visit, lack);
    }

    int dimension_;
    PackedTree tree_;
};

}  // namespace rrcb
