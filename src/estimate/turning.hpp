#pragma once

#include "estimate/contribution.hpp"

#include <rrcb/detail/bisection.hpp>
#include <rrcb/options.hpp>

#include <span>

// Decides when cuts turn to other axes than those of earlier cuts, and which numbers their parts
// then get.

namespace rrcb {

/// Bisects the cells of all ranks, whose density is `domain`. `preferred` has the meaning as in
/// bisect().
Bisection bisect_gathered(const StatisticalDomain& domain, const Contribution& all,
                          const Options& options, bool with_brackets,
                          std::span<const int> preferred = {}, double* near_weight = nullptr);

/// Bisects the cells of all ranks across the axes of `earlier` cuts. Turns the cuts to freely
/// chosen axes when that pays: when the ghosts that free axes would have saved since the axes were
/// chosen outweigh the points that turning moves. These saved ghosts are the debt.
///
/// The returned cuts have the new debt, and numbers with which most points remain in their part of
/// `earlier`.
Bisection bisect_along(const StatisticalDomain& domain, const Contribution& all,
                       const Options& options, const Cuts& earlier);

/// Numbers the parts of `cuts` so that as much weight as possible remains in its part of `earlier`;
/// the numbers are found greedily. Parts of unequal sizes keep the numbers of the ends. Returns the
/// share of the weight that moves.
double keep_numbers(const StatisticalDomain& domain, std::span<const double> part_sizes,
                    const Cuts& earlier, Cuts& cuts);

}  // namespace rrcb
