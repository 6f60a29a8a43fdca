#pragma once

#include "arithmetic/infinity.hpp"
#include "cuts/packed_tree.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// The points within a radius, which is finite, of a centre; none if it is below 0.
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

    /// Returns the ball of the greater of two radii.
    Ball widened(double radius) const {
        const Ball other(centre_, radius);
        return other.reach_ > reach_ ? other : *this;
    }

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

/// Distances within which the points of each part need others.
///
/// Each part has two: the greatest radius, from the box of its points with more than half of it,
/// and the greatest of the other radii, from the box of these. Numbered as the ends of the tree.
class PartReaches {
  public:
    /// Throws std::bad_alloc. No part needs points so far.
    PartReaches(int num_parts, int dimension)
        : dimension_(dimension), numbers_(num_parts * width(), -infinity) {}

    /// Notes a radius of this rank, before all places.
    void note_radius(Part end, double radius) { raise(numbers_[end * width()], radius); }

    /// Notes the place of the same point.
    void note_place(Part end, double radius, const Vector& x) {
        const bool is_great = radius > of(end) / 2;
        double* reach = &numbers_[end * width() + (is_great ? 0 : 1 + 2 * dimension_)];
        raise(*reach, radius);
        for (int a = 0; a < dimension_; ++a) {
            raise(*++reach, -x[a]);
            raise(*++reach, x[a]);
        }
    }

    /// Returns the numbers of all parts, of which the ranks take the maximum.
    std::span<double> numbers() { return numbers_; }

    double of(Part end) const { return numbers_[end * width()]; }
    double greatest() const {
        double greatest = -infinity;
        for (std::size_t k = 0; k < numbers_.size(); k += width())
            greatest = std::max(greatest, numbers_[k]);
        return greatest;
    }

    /// Returns true if a part needs the centre of a ball, or the ball touches a box of its points.
    bool reaches(Part end, const Ball& ball) const {
        const double* great = &numbers_[end * width()];
        return reaches_from(great, ball) ||
               reaches_from(great + 1 + std::size_t{2} * dimension_, ball);
    }

  private:
    std::size_t width() const { return 2 + 4 * static_cast<std::size_t>(dimension_); }
    static void raise(double& number, double to) { number = std::max(number, to); }

    bool reaches_from(const double* reach, const Ball& ball) const {
        Vector apart{};
        for (int a = 0; a < dimension_; ++a)
            apart[a] =
                std::max(-reach[1 + 2 * a] - ball.centre()[a], ball.centre()[a] - reach[2 + 2 * a]);
        return ball.widened(*reach).touches(apart, dimension_);
    }

    int dimension_;
    std::vector<double>
        numbers_;  ///< of each part: twice a reach and a box, its lower ends negated
};

/// Finds the parts whose closed region a ball touches, except some. An empty region is never
/// touched.
class BallSearch {
  public:
    /// Leaves out the parts for which leaves_out(part, region), called in ascending order, is true.
    /// `cuts` and `reaches` outlive the search. With `reaches` it also finds the parts that need
    /// the centre.
    template <class LeavesOut>
    BallSearch(const Cuts& cuts, LeavesOut&& leaves_out, const PartReaches* reaches = nullptr)
        : dimension_(cuts.dimension),
          tree_(cuts,
                [&](Part part, const Box& region) {
                    return leaves_out(part, region) || is_region_empty(cuts, part, region)
                               ? left_out
                               : part;
                }),
          reaches_(reaches) {
        if (reaches != nullptr) find_reaches();
    }

    /// Calls visit(part), and lack(node) for nodes whose cut is unknown, both ascending. Time:
    /// these calls times the depth of the tree. `apart` are the distances from the centre to the
    /// box that limits all regions.
    template <class Visit, class Lack>
    void for_each_part(const Ball& ball, Visit&& visit, Lack&& lack,
                       const Vector& apart = {}) const {
        descend(0, ball, apart, visit, lack);
    }

  private:
    /// `apart` are the distances from the centre to the region of the node along the axes.
    template <class Visit, class Lack>
    void descend(std::int32_t node, const Ball& ball, const Vector& apart, Visit&& visit,
                 Lack&& lack) const {
        if (!(reaches_ ? ball.widened(greatest_[node]) : ball).touches(apart, dimension_)) return;
        if (tree_.is_end(node)) {
            const Part entry = tree_.entry_at(node);
            if (entry == left_out) return;
            if (is_unknown(entry)) return lack(unknown_node(entry));
            if (!reaches_ || reaches_->reaches(entry, ball)) visit(entry);
            return;
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

    /// Notes the greatest reach at or below each node; nodes follow the ones above them.
    void find_reaches() {
        const double of_all = reaches_->greatest();
        greatest_.resize(tree_.num_nodes());
        for (std::int32_t node = tree_.num_nodes(); node-- > 0;) {
            const std::int32_t lower = tree_.lower_of(node);
            if (!tree_.is_end(node)) {
                greatest_[node] = std::max(greatest_[lower], greatest_[lower + 1]);
                continue;
            }
            const Part entry = tree_.entry_at(node);
            greatest_[node] = entry == left_out   ? -infinity
                              : is_unknown(entry) ? of_all
                                                  : reaches_->of(entry);
        }
    }

    int dimension_;
    PackedTree tree_;
    const PartReaches* reaches_;
    std::vector<double> greatest_{};  ///< reach of the parts at or below each node
};

}  // namespace rrcb
