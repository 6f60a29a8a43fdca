#pragma once

#include "cuts/owned_cuts.hpp"
#include "cuts/tree.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <span>
#include <vector>

namespace rrcb {

/// Finds the parts whose closed region a ball touches, but for some that are left out. A region
/// that holds no position is touched by none.
class BallSearch {
  public:
    /// The ranges that are left out ascend and do not touch; the radius is finite, 0 or more.
    /// `cuts` and ranges outlive the search.
    BallSearch(const Cuts& cuts, double radius, std::span<const PartRange> left_out)
        : cuts_(cuts),
          reach_(std::min(radius * (1 + 4 * epsilon), std::numeric_limits<double>::max())),
          unit_(reach_ > 0 ? reach_ : 1),
          left_out_(left_out),
          empty_(empty_parts(cuts)) {}

    /// Calls visit(part), and lack(node) where the cut of a node is not known; both ascend. In time
    /// as there are such parts times the depth of the tree.
    template <class Visit, class Lack>
    void for_each_part(const Vector& centre, Visit&& visit, Lack&& lack) const {
        descend(root_of(cuts_), centre, {}, visit, lack);
    }

    /// True when the ball is in the interior of a box.
    bool is_inside(const Vector& centre, const Box& box) const {
        for (std::size_t a = 0; a < static_cast<std::size_t>(cuts_.dimension); ++a)
            if (!(centre[a] - box.lower[a] > reach_ && box.upper[a] - centre[a] > reach_))
                return false;
        return true;
    }

  private:
    static constexpr double epsilon = std::numeric_limits<double>::epsilon();

    /// Whether a range holds all parts of a node: the last one that begins no later.
    bool is_left_out(const Descent& at) const {
        const auto next = std::ranges::upper_bound(left_out_, at.first_part, {}, &PartRange::first);
        return next != left_out_.begin() && at.first_part + at.num_parts <= std::prev(next)->end;
    }

    bool is_near(const Vector& apart) const {
        double square = 0;
        for (std::size_t a = 0; a < static_cast<std::size_t>(cuts_.dimension); ++a) {
            if (apart[a] > reach_) return false;
            if (apart[a] > 0) square += (apart[a] / unit_) * (apart[a] / unit_);
        }
        return square <= 1 + 8 * epsilon;
    }

    /// Each entry of `apart` is the distance of the centre, along that axis, to the region of `at`.
    template <class Visit, class Lack>
    void descend(const Descent& at, const Vector& centre, const Vector& apart, Visit&& visit,
                 Lack&& lack) const {
        if (is_left_out(at) || !is_near(apart)) return;
        if (at.is_part()) {
            if (!std::ranges::binary_search(empty_, at.first_part)) visit(at.first_part);
            return;
        }
        const Cut* cut = find_cut(cuts_, at.node);
        if (cut == nullptr) return lack(at.node);
        const auto axis = static_cast<std::size_t>(cut->axis);
        Vector below = apart;
        Vector above = apart;
        below[axis] = std::max(apart[axis], centre[axis] - cut->at[axis]);
        above[axis] = std::max(apart[axis], cut->at[axis] - centre[axis]);
        descend(at.lower(), centre, below, visit, lack);
        descend(at.upper(), centre, above, visit, lack);
    }

    const Cuts& cuts_;
    double reach_;  ///< the radius, and what rounding may add to a distance
    double unit_;   ///< of lengths, so that their squares do not overflow
    std::span<const PartRange> left_out_;
    std::vector<Part> empty_;  ///< whose region is empty
};

}  // namespace rrcb
