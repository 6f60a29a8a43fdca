#pragma once

#include "cuts/cut_limits.hpp"

#include <rrcb/method/bisection.hpp>
#include <rrcb/method/statistical_domain.hpp>

namespace rrcb {

double weight_of(const StatisticalDomain& domain);
Box extent_of(const StatisticalDomain& domain);

/// Returns the range of the cut if the domain is slightly wrong; `below` is the share of the weight
/// below it, `depth` the number of cuts above.
Bracket bracket_of(const StatisticalDomain& domain, const Cut& cut, double below, int depth);

/// A domain on both sides of a cut.
struct Halves {
    StatisticalDomain lower;
    StatisticalDomain upper;
};

Halves split_domain(const StatisticalDomain& domain, const Cut& cut);

}  // namespace rrcb
