#pragma once

#include <rrcb/method/bisection.hpp>

namespace rrcb {

/// Returns the share of a node's weight below its cut: the sizes of its first `num_below` parts
/// over all `sizes`.
double share_below(std::span<const double> sizes, int num_below);

/// Returns the expected error of an estimated cut, as a share of the node's weight. It grows with
/// `depth`, the number of cuts above, because fewer cells are left.
double expected_error(int depth);

/// As the public function, with complete options and, on request, the brackets of the cuts.
Bisection bisect(StatisticalDomain domain, const Options& options, bool with_brackets);

}  // namespace rrcb
