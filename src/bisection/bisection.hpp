#pragma once

#include <rrcb/method/bisection.hpp>

namespace rrcb {

/// Returns the share of a node's weight below its cut: the sizes of its first `num_below` parts
/// over all `sizes`. A side too small for sums of weights to resolve gets nothing.
double share_below(std::span<const double> sizes, int num_below);

/// Returns the expected error of an estimated cut, as a share of the node's weight. It grows with
/// `depth`, the number of cuts above, because fewer cells are left.
double expected_error(int depth);

/// Share of a mean half side of the patches within which weight is near the cuts.
inline constexpr double near_share = 0.25;

/// As the public function, with complete options and, on request, the brackets of the cuts. The
/// domain stands for `num_points`; 0: for any number. Axes of `preferred`, one per cut in preorder
/// or none, are taken where that is possible. `near_weight` gets the weight near all cuts.
Bisection bisect(StatisticalDomain domain, const Options& options, bool with_brackets,
                 GlobalCount num_points = 0, std::span<const int> preferred = {},
                 double* near_weight = nullptr);

/// Returns true if the weight near all cuts, times `enough`, is not more than that near `fresh`
/// cuts of the same domain. Points in few places have no weight near cuts that could be compared.
bool are_axes_good(const StatisticalDomain& domain, const Cuts& cuts, const Cuts& fresh,
                   double enough);

}  // namespace rrcb
