#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/detail/statistical_domain.hpp>
#include <rrcb/options.hpp>

#include <span>

namespace rrcb {

/// Range across the axis of a cut in which the cut of the real points is expected.
struct Bracket {
    double lower = 0;  ///< least coordinate of the range
    double upper = 0;  ///< greatest coordinate of the range
};

/// Cuts of a domain, and the weight in each of its parts.
struct Bisection {
    Cuts cuts;                         ///< of the domain
    std::vector<Bracket> brackets;     ///< of each cut; empty if they were not asked for
    std::vector<double> part_weights;  ///< length num_parts, of the domain
};

/// Bisects a domain recursively, each box across one of its longest axes. Not collective.
///
/// @param domain     a copy, which is divided
/// @param num_parts  1 or more
/// @param part_sizes relative, one per part, or empty; a part of size 0 gets an empty region
/// @return cuts with weights below and above in the ratio of the sizes, exactly for the
/// piecewise-linear cumulative weight of the patches
/// Throws Error for a number of parts below 1, illegal sizes (see Options::part_sizes), or an
/// illegal dimension.
Bisection bisect(StatisticalDomain domain, int num_parts, std::span<const double> part_sizes);

}  // namespace rrcb
