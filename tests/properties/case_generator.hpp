#pragma once

#include "case_mpi.hpp"

#include <rapidcheck.h>

namespace rrcb::test {

/// Cases of any kind; simpler ones come first when a failing one is shrunk.
rc::Gen<Case> any_case();

}  // namespace rrcb::test
