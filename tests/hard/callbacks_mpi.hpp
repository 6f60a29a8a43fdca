#pragma once

#include "cloud.hpp"

namespace rrcb::hard_test {

/// Divides a cloud through Zoltan's functions with every method of RRCB's and checks the parts, the
/// look-ups and the lists. Collective.
void check_callbacks(const Cloud& cloud);

}  // namespace rrcb::hard_test
