#pragma once

#include <rrcb/detail/bisection.hpp>

namespace rrcb {

/// Returns the share of a node's weight below its cut: the sizes of its first `num_below` parts
/// divided by the sum of all `sizes`. A side gets 0 if it is too small to be resolved by sums of
/// weights.
double share_below(std::span<const double> sizes, int num_below);

/// Returns the expected error of an estimated cut, as a share of the node's weight. It grows with
/// `depth`, the number of cuts above, because fewer cells are left.
double expected_error(int depth);

/// Weight counts as near a cut up to this share of the patches' mean half side.
inline constexpr double near_share = 0.25;

/// Bisects as the public function, from complete options, and also computes the brackets of the
/// cuts if `with_brackets`. The domain stands for `num_points` points; 0 means that their number is
/// unknown. `preferred` has one axis for each cut in preorder, or is empty; these axes are taken
/// where possible. `near_weight` gets the weight near all cuts.
Bisection bisect(StatisticalDomain domain, const Options& options, bool with_brackets,
                 GlobalCount num_points = 0, std::span<const int> preferred = {},
                 double* near_weight = nullptr);

/// Returns true if `enough` times the weight near `cuts` is at most the weight near `fresh`, which
/// are cuts of the same domain. Also returns true if all patches are points: then the weight near a
/// cut cannot be estimated.
bool are_axes_good(const StatisticalDomain& domain, const Cuts& cuts, const Cuts& fresh,
                   double enough);

}  // namespace rrcb
