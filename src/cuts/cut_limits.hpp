#pragma once

#include "cuts/axis_limits.hpp"
#include "cuts/box_packing.hpp"

#include <rrcb/options.hpp>

namespace rrcb {

/// Returns the limits of cuts across each axis; for any options.
std::array<AxisLimits, max_dimension> axis_limits(const Options& options);

/// Allowed places of a cut, both ends included.
struct Places {
    double first = -std::numeric_limits<double>::infinity();
    double last = std::numeric_limits<double>::infinity();

    bool empty() const { return !(first <= last); }
    bool all() const { return first < -std::numeric_limits<double>::max(); }
};

/// Allowed places of the cuts of a tree: all parts have the least width, and all cuts are on lines.
///
/// If the complete tree has room, a cut at any of its allowed places leaves places to all cuts
/// below it.
class CutLimits {
  public:
    /// Takes complete options with limits of cuts, the box of the points, and the axes of the cuts
    /// in preorder, none if they are free. Throws Error if the grid is too fine.
    CutLimits(const Options& options, const Box& points, int dimension,
              std::vector<int> given = {});

    /// Returns the box to be cut.
    const Box& region() const { return region_; }

    int dimension() const { return dimension_; }
    bool are_axes_given() const { return !given_.empty(); }

    bool has_room();

    /// Throws Error with the possible number of parts if there is not enough room.
    void require_room();

    /// Returns true if weight may be on both sides of the cut of a node.
    bool divides(const Descent& at) const {
        return packing_.num_parts(at.lower()) > 0 && packing_.num_parts(at.upper()) > 0;
    }

    /// Returns the places of the cut of a node that divides `region` across `axis`, the given axis
    /// if axes are given.
    Places places(const Descent& at, const Box& region, int axis);

    /// Returns `cut` if it is at one of its places; otherwise the plane at the nearest.
    Cut nearest(const Cut& cut, const Places& places) const;

    const AxisLimits& across(int axis) const { return axes_[axis]; }

  private:
    Room room_in(const Box& region, int most) const;
    bool has_room_across(const Descent& at, int axis);
    /// Returns the child with parts of a node without a division.
    Descent with_parts(const Descent& at) const {
        return packing_.num_parts(at.lower()) > 0 ? at.lower() : at.upper();
    }
    double nearest_face(const Descent& at, int axis, double face, bool is_behind) const;

    std::array<AxisLimits, max_dimension> axes_;
    Box region_;
    int dimension_;
    std::vector<int> allowed_;
    Descent whole_;
    BoxPacking packing_;
    std::vector<int> given_;
    const char* limiting_;  ///< options, with a verb
};

}  // namespace rrcb
