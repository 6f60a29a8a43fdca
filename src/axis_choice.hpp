#pragma once

#include <rrcb/options.hpp>
#include <rrcb/points.hpp>

#include <vector>

namespace rrcb {

/// Axis of the greatest extent, the first of equals.
int longest_axis(const Box& box, int dimension);

/// Which axis each cut crosses: the one it was given, the one of its level, or its longest.
class AxisChoice {
  public:
    /// `box` is that of all points; options are complete and checked.
    AxisChoice(const Options& options, const Box& box, int dimension);

    /// Axis of cut number `node` in preorder, at `depth` cuts below the root, across `box`.
    int operator()(std::size_t node, int depth, const Box& box) const;

  private:
    std::vector<int> cut_axes_;
    std::vector<int> level_axes_;
    int dimension_;
};

}  // namespace rrcb
