#pragma once

#include "cloud.hpp"

namespace rrcb::hard_test {

/// Divides a cloud by `balance` with every method and checks all it returns. Collective.
void check_interface(const Cloud& cloud);

}  // namespace rrcb::hard_test
