#pragma once

#include "cuts/tree.hpp"

#include <rrcb/options.hpp>
#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// An axis is replaced by another one only if that one is better by a tenth. Extents and weights of
/// an analytic domain are estimates: without this margin small changes would turn the cuts of a
/// cube, and half of the points would move.
inline constexpr double nearly = 0.9;

/// Returns the first of `axes` whose extent is at least `enough` times the greatest extent.
int longest_axis(const Box& box, std::span<const int> axes, double enough);

/// Chooses the axes that each cut may cross: the given axis, the axis of its level, or all allowed
/// ones.
class AxisChoice {
  public:
    /// The box contains all points, and the options are complete and checked. The options must
    /// outlive this object.
    AxisChoice(const Options& options, const Box& box, int dimension);

    /// Returns the axes of cut number `node` in preorder, at `depth` cuts below the root.
    std::span<const int> operator()(std::size_t node, int depth) const;

    /// Returns the axes of the cuts below the root of a tree, in preorder; empty if they are not
    /// given.
    std::vector<int> given(const Descent& root) const;

  private:
    void append_given(const Descent& at, int depth, std::vector<int>& axes) const;

    std::vector<int> cut_axes_;
    std::vector<int> level_axes_;
    std::span<const int> allowed_;
};

}  // namespace rrcb
