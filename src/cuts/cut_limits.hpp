#pragma once

#include "cuts/axis_limits.hpp"
#include "cuts/box_packing.hpp"

#include <rrcb/options.hpp>

namespace rrcb {

/// Returns the limits of cuts across each axis; if the options have no limits, these allow
/// everything.
std::array<AxisLimits, max_dimension> axis_limits(const Options& options);

/// Interval of allowed positions of a cut; both ends are allowed.
struct Places {
    double first = -std::numeric_limits<double>::infinity();
    double last = std::numeric_limits<double>::infinity();

    bool empty() const { return !(first <= last); }
    bool all() const { return first < -std::numeric_limits<double>::max(); }
};

/// Allowed positions of the cuts of a tree: all parts have at least the minimum width, and all cuts
/// are on grid lines.
///
/// If the complete tree fits, a cut at any of its allowed positions leaves allowed positions for
/// all cuts below it.
class CutLimits {
  public:
    /// Takes complete options that limit cuts, the box of the points, and the axes of the cuts in
    /// preorder, which are empty if axes are free. Throws Error if the grid is too fine.
    CutLimits(const Options& options, const Box& points, int dimension,
              std::vector<int> given = {});

    /// Returns the box that the cuts divide.
    const Box& region() const { return region_; }

    int dimension() const { return dimension_; }
    bool are_axes_given() const { return !given_.empty(); }

    bool has_room();

    /// Throws Error with the number of parts that are possible, if there is not enough room.
    void require_room();

    /// Returns true if both sides of a node's cut have parts of a size above 0.
    bool divides(const Descent& at) const {
        return packing_.num_parts(at.lower()) > 0 && packing_.num_parts(at.upper()) > 0;
    }

    /// Returns the allowed positions of the cut of a node that divides `region` across `axis`. If
    /// axes are given, `axis` must be the given one.
    Places places(const Descent& at, const Box& region, int axis);

    /// Returns `cut` if it is at an allowed position; otherwise the plane at the nearest one.
    Cut nearest(const Cut& cut, const Places& places) const;

    const AxisLimits& across(int axis) const { return axes_[axis]; }

  private:
    Room room_in(const Box& region, int most) const;
    bool has_room_across(const Descent& at, int axis);
    /// Of a node that does not divide, returns the child that has parts of a size above 0.
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
    const char* limiting_;  ///< names of the limiting options and a verb, for errors
};

}  // namespace rrcb
