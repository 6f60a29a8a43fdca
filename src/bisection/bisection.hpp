#pragma once

#include <rrcb/method/bisection.hpp>

namespace rrcb {

/// Returns the share of a node's weight below its cut, from the relative sizes of its parts, of
/// which the first `num_below` are below.
double share_below(std::span<const double> sizes, int num_below);

/// Returns the expected error of an estimated cut, as a share of the node's weight. It grows with
/// `depth`, the number of cuts above, because fewer cells are left.
double expected_error(int depth);

/// Bisects as the public function, by complete options; on request with the brackets of the cuts.
Bisection bisect(StatisticalDomain domain, const Options& options, bool with_brackets);

}  // namespace rrcb
