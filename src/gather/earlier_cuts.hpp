#pragma once

#include <rrcb/method/bisection.hpp>

#include <vector>

namespace rrcb {

/// The cuts of an earlier call, or those that this rank knows, such as complete options ask for:
/// planes, and nothing in parts of size 0. They divide no points of one place, which the look-up
/// keeps together.
Cuts fitted(Cuts previous, const Options& options);

/// Adds brackets about cuts, as wide as those that estimated cuts of an even cloud in `box` would
/// have; none if the box is empty. Takes memory for one per cut.
void bracket_earlier(const Cuts& cuts, const Box& box, std::vector<Bracket>& brackets);

}  // namespace rrcb
