#pragma once

#include <rrcb/method/bisection.hpp>

#include <vector>

namespace rrcb {

/// Returns the cuts of an earlier call, or those of them that this rank knows, fitted to complete
/// options: planes if asked for, and nothing in parts of size 0. They divide no coincident points,
/// which the look-up keeps together.
Cuts fitted(Cuts previous, const Options& options);

/// Adds brackets about cuts, as wide as estimated cuts of evenly spread points in `box` would have;
/// none if the box is empty. Takes memory for one per cut.
void bracket_earlier(const Cuts& cuts, const Box& box, std::vector<Bracket>& brackets);

}  // namespace rrcb
