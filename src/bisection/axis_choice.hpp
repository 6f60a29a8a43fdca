#pragma once

#include "cuts/tree.hpp"

#include <rrcb/options.hpp>
#include <rrcb/points.hpp>

#include <vector>

namespace rrcb {

/// Share of the greatest extent above which axes of a statistical domain count as equally long.
inline constexpr double near_longest = 0.9;

/// Returns the first axis whose extent is at least the share `enough` of the greatest.
int longest_axis(const Box& box, int dimension, double enough);

/// Chooses the axis that each cut crosses: the given one, that of its level, or the longest.
///
/// The extents of an analytic domain are estimates, so axes of nearly the same extent count as
/// equal. Otherwise small changes would turn the cuts of a cube and move half of the points.
class AxisChoice {
  public:
    /// `box` is that of all points; options are complete and checked.
    AxisChoice(const Options& options, const Box& box, int dimension);

    /// Returns the axis of cut number `node` in preorder, at `depth` cuts below the root, across
    /// `box`.
    int operator()(std::size_t node, int depth, const Box& box) const;

    /// Returns true if the axis of a cut does not depend on the domain.
    bool is_given() const { return !cut_axes_.empty() || !level_axes_.empty(); }

    /// Returns the axes of the cuts below the root of a tree, in preorder; empty if they are not
    /// given.
    std::vector<int> given(const Descent& root) const;

  private:
    void append_given(const Descent& at, int depth, std::vector<int>& axes) const;

    std::vector<int> cut_axes_;
    std::vector<int> level_axes_;
    int dimension_;
};

}  // namespace rrcb
