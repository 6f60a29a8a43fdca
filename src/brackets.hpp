#pragma once

#include <rrcb/bisection.hpp>

namespace rrcb {

/// Share of a node's weight that belongs below its cut, from the relative sizes of its parts.
double share_below(std::span<const double> sizes);

/// As the public function, with one size per part; on request with the brackets of the cuts.
Bisection bisect(StatisticalDomain domain, std::span<const double> part_sizes, CutRule rule,
                 bool with_brackets);

}  // namespace rrcb
