#pragma once

#include <rrcb/options.hpp>

namespace rrcb {

/// Allowed places of cuts across one axis.
///
/// Boxes are side by side between two faces, which may be anywhere, with a cut between neighbours.
/// `upper - lower` of each box, as computed, is at least `min_width`, and above 0. Results are
/// exact: first_behind() and last_before() are inverse, so that boxes that fit when counted from
/// one end fit from the other.
class AxisLimits {
  public:
    /// `min_width` 0 and a `spacing` of 0 stand for none.
    AxisLimits() = default;
    AxisLimits(double min_width, const GridLines& grid) : min_width_(min_width), grid_(grid) {}

    bool has_grid() const { return grid_.spacing > 0; }

    /// Returns true if the lines of the grid are different doubles up to `magnitude`.
    bool resolves(double magnitude) const;

    /// Returns the least place of a cut with room for `count` boxes between `face` and it, or
    /// infinity.
    double first_behind(double face, int count) const;

    /// Returns the greatest place of a cut with room for `count` boxes between it and `face`.
    double last_before(double face, int count) const;

    /// Returns the number of boxes with room between two faces, from 1 to `most`.
    int count_between(double lower, double upper, int most) const;

    /// Returns the place nearest to `value` in [first, last], which are places.
    double nearest(double value, double first, double last) const;

    /// Return the next place above and below a value, for any faces.
    double place_behind(double value) const;
    double place_before(double value) const;

    /// Returns the position of line number `k` of the grid.
    double line(double k) const;

    /// Returns the number of the last line not above `value`.
    double line_below(double value) const;

  private:
    bool is_apart(double lower, double upper) const;
    double next_behind(double face) const;
    AxisLimits mirrored() const { return {min_width_, {-grid_.origin, grid_.spacing}}; }

    double min_width_ = 0;
    GridLines grid_{0, 0};
};

}  // namespace rrcb
