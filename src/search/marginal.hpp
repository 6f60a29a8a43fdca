#pragma once

#include "passes/bins.hpp"

#include <rrcb/points.hpp>

#include <span>

namespace rrcb {

/// Weight of the points of a node in the slots along an axis.
struct Marginal {
    int axis;
    Bins bins;
    std::span<const double> weights;
};

/// Returns the index of the axis to cut: `longest`, that of the longest extent of the box of the
/// points, unless a cut across another has clearly less weight near it. `marginals` are along the
/// axes that may be cut; `target` > 0 is the weight below the cut.
std::size_t fewest_near(std::span<const Marginal> marginals, const Box& box, std::size_t longest,
                        double target, double num_points);

}  // namespace rrcb
