#pragma once

#include "../zoltan/program.hpp"
#include "share.hpp"

#include <vector>

namespace rrcb::hard_test {

/// Makes the points of `share` the objects of a program.
void fill(zoltan_test::Program& program, const Share& share);

/// Part of each object after a call with RETURN_LISTS=PARTS and a part per rank, or a change.
std::vector<int> parts_of(const zoltan_test::Program& program, const zoltan_test::Outcome& outcome);

/// Divides a cloud through Zoltan's functions with every method of RRCB's and checks the parts, the
/// look-ups and the lists. Collective.
void check_callbacks(const Cloud& cloud);

}  // namespace rrcb::hard_test
