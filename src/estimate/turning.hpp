#pragma once

#include "estimate/contribution.hpp"

#include <rrcb/method/bisection.hpp>
#include <rrcb/options.hpp>

#include <span>

// When cuts turn to other axes than those of earlier cuts, and which numbers their parts have then.

namespace rrcb {

/// Bisects the cells of all ranks, whose density is `domain`. `preferred` as for bisect().
Bisection bisect_gathered(const StatisticalDomain& domain, const Contribution& all,
                          const Options& options, bool with_brackets,
                          std::span<const int> preferred = {}, double* near_weight = nullptr);

/// Bisects the cells of all ranks across the axes of `earlier` cuts, unless the ghosts that freely
/// chosen axes would have saved since these were chosen pay for the points that turning moves.
///
/// The cuts have numbers, by which most points stay in their part of `earlier`, and the new debt.
Bisection bisect_along(const StatisticalDomain& domain, const Contribution& all,
                       const Options& options, const Cuts& earlier);

/// Numbers the parts of `cuts` so that the most weight stays in its part of `earlier`, as greedily
/// found; parts of unequal sizes keep those of the ends. Returns the share of the weight that
/// moves.
double keep_numbers(const StatisticalDomain& domain, std::span<const double> part_sizes,
                    const Cuts& earlier, Cuts& cuts);

}  // namespace rrcb
