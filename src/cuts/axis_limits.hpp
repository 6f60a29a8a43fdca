#pragma once

#include <rrcb/options.hpp>

namespace rrcb {

/// Allowed positions of cuts across one axis.
///
/// Boxes are next to each other between two faces, which may be anywhere; a cut separates
/// neighbours. For each box the computed `upper - lower` is at least `min_width` and above 0.
/// Results are exact: first_behind() and last_before() are inverse functions, so that boxes which
/// fit when counted from one end also fit from the other.
class AxisLimits {
  public:
    /// A `min_width` or `spacing` of 0 means that there is none.
    AxisLimits() = default;
    AxisLimits(double min_width, const GridLines& grid) : min_width_(min_width), grid_(grid) {}

    bool has_grid() const { return grid_.spacing > 0; }

    /// Returns true if different grid lines up to `magnitude` are different doubles.
    bool resolves(double magnitude) const;

    /// Returns the least position of a cut that leaves room for `count` boxes between `face` and
    /// the cut; infinity if there is none.
    double first_behind(double face, int count) const;

    /// Returns the greatest position of a cut that leaves room for `count` boxes between the cut
    /// and `face`.
    double last_before(double face, int count) const;

    /// Returns how many boxes fit between two faces, from 1 to `most`.
    int count_between(double lower, double upper, int most) const;

    /// Returns the allowed position nearest to `value` in [first, last], both of which are allowed.
    double nearest(double value, double first, double last) const;

    /// Return the next allowed position above and below a value, without regard to faces.
    double place_behind(double value) const;
    double place_before(double value) const;

    /// Returns the position of line number `k` of the grid.
    double line(double k) const;

    /// Returns the number of the last grid line at or below `value`.
    double line_below(double value) const;

  private:
    bool is_apart(double lower, double upper) const;
    double next_behind(double face) const;
    AxisLimits mirrored() const { return {min_width_, {-grid_.origin, grid_.spacing}}; }

    double min_width_ = 0;
    GridLines grid_{0, 0};
};

}  // namespace rrcb
