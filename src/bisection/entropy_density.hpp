#pragma once

#include "bisection/cell_density.hpp"

#include <vector>

namespace rrcb {

/// The density of greatest entropy on [lower, upper] among those that have this mean and this
/// deviation, exp(a + b x + c x^2), as a few pieces that keep its moments: for cells so heavy that
/// they are cut more than once. Where it is next to quadratic, or hard to find, as density_of() has
/// it.
///
/// Jaynes: Information theory and statistical mechanics (1957).
std::vector<DensityPiece> entropy_density_of(double mean, double deviation, double lower,
                                             double upper);

}  // namespace rrcb
