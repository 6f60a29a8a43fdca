#pragma once

#include "zoltan/handle/state.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/remap.hpp>

namespace rrcb::zoltan {

/// Prints on rank 0 what is legal but not as good as it was asked for, unless DEBUG_LEVEL is 0, and
/// the line of RCB_OUTPUT_LEVEL where it is asked for. Not collective; lack of memory is no
/// failure.
void print_notices(const Report& report, int num_parts, const Remap& remap, const State& state,
                   const char* function) noexcept;

}  // namespace rrcb::zoltan
