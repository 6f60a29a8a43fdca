#pragma once

#include "bisection/cell_density.hpp"

#include <rrcb/detail/statistical_domain.hpp>

#include <array>
#include <vector>

namespace rrcb {

/// Part of a density along one axis; Patch explains slope and bow.
struct DensityPiece {
    double lower = 0;
    double upper = 0;
    double share = 0;  ///< of the weight
    double slope = 0;
    double bow = 0;
};

/// A density along one axis: one piece, or two if the second has a share above 0.
using AxisDensity = std::array<DensityPiece, 2>;

/// Returns a density on [lower, upper] with this mean and standard deviation, or with the nearest
/// ones that a density on the interval can have; see analytic_domain().
AxisDensity density_of(double mean, double deviation, double lower, double upper);

/// Returns the density of greatest entropy on [lower, upper] with this mean and standard deviation,
/// exp(a + b x + c x^2), as a few pieces that keep its moments. It is meant for heavy cells, which
/// are cut more than once. Returns density_of() if that is a single piece on the complete interval,
/// or if the search fails.
///
/// Source: Jaynes: Information theory and statistical mechanics (1957).
std::vector<DensityPiece> entropy_density_of(double mean, double deviation, double lower,
                                             double upper);

}  // namespace rrcb
