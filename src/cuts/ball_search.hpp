#pragma once

#include "cuts/tree.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace rrcb {

/// Finds the parts whose closed region a ball touches, of those that are asked for.
class BallSearch {
  public:
    /// `is_wanted` has an entry for each part; the radius is finite, 0 or more. `cuts` outlive the
    /// search. Throws std::bad_alloc.
    BallSearch(const Cuts& cuts, double radius, std::span<const char> is_wanted)
        : cuts_(cuts),
          reach_(std::min(radius * (1 + 4 * epsilon), std::numeric_limits<double>::max())),
          unit_(reach_ > 0 ? reach_ : 1),
          num_wanted_before_(is_wanted.size() + 1, 0) {
        std::inclusive_scan(is_wanted.begin(), is_wanted.end(), num_wanted_before_.begin() + 1,
                            std::plus<>(), 0);
    }

    /// Calls visit(part), ascending. In time as there are such parts times the depth of the tree.
    template <class Visit>
    void for_each_part(const Vector& centre, Visit&& visit) const {
        descend(root_of(cuts_), centre, {}, visit);
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

    bool has_wanted(const Descent& at) const {
        const auto first = static_cast<std::size_t>(at.first_part);
        return num_wanted_before_[first] !=
               num_wanted_before_[first + static_cast<std::size_t>(at.num_parts)];
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
    template <class Visit>
    void descend(const Descent& at, const Vector& centre, const Vector& apart,
                 Visit&& visit) const {
        if (!has_wanted(at) || !is_near(apart)) return;
        if (at.is_part()) return visit(at.first_part);
        const Cut& cut = cuts_.tree[at.node];
        const auto axis = static_cast<std::size_t>(cut.axis);
        Vector below = apart;
        Vector above = apart;
        below[axis] = std::max(apart[axis], centre[axis] - cut.at[axis]);
        above[axis] = std::max(apart[axis], cut.at[axis] - centre[axis]);
        descend(at.lower(), centre, below, visit);
        descend(at.upper(), centre, above, visit);
    }

    const Cuts& cuts_;
    double reach_;                        ///< the radius, and what rounding may add to a distance
    double unit_;                         ///< of lengths, so that their squares do not overflow
    std::vector<int> num_wanted_before_;  ///< parts of lower numbers; one entry more than parts
};

}  // namespace rrcb
