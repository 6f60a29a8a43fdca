#pragma once

#include <rrcb/method/statistical_domain.hpp>

#include <array>

namespace rrcb {

/// Part of a density along one axis, see Patch.
struct DensityPiece {
    double lower = 0;
    double upper = 0;
    double share = 0;  ///< of the weight
    double slope = 0;
    double bow = 0;
};

/// A density along one axis: one piece, or two, the second then has a share above 0.
using AxisDensity = std::array<DensityPiece, 2>;

/// Returns a density on [lower, upper] with this mean and deviation, or with nearby ones if no
/// points of the interval have these; see analytic_domain().
AxisDensity density_of(double mean, double deviation, double lower, double upper);

}  // namespace rrcb
