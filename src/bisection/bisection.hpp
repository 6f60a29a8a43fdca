#pragma once

#include <rrcb/method/bisection.hpp>

namespace rrcb {

/// Share of a node's weight that belongs below its cut, from the relative sizes of its parts, of
/// which the first `num_below` lie there.
double share_below(std::span<const double> sizes, int num_below);

/// Share of a node's weight by which an estimated cut is expected to be off: more where a node,
/// `depth` cuts below the root, has fewer cells left.
double expected_error(int depth);

/// Bisects as the public function does, by complete options; on request with the brackets of the
/// cuts.
Bisection bisect(StatisticalDomain domain, const Options& options, bool with_brackets);

}  // namespace rrcb
