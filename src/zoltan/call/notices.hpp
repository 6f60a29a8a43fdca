#pragma once

#include "zoltan/call/partition_mpi.hpp"
#include "zoltan/handle/state.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/remap.hpp>

namespace rrcb::zoltan {

Summary summary_of(const Report& report, int num_parts);

/// Prints warnings and a report line on rank 0. Not collective. Prints nothing if there is no
/// memory.
///
/// Warnings are about legal results that miss their targets; there are none with DEBUG_LEVEL 0. The
/// line is printed if RCB_OUTPUT_LEVEL or a similar parameter asks for it.
void print_notices(const Report& report, int num_parts, const Remap& remap, const State& state,
                   const char* function) noexcept;

}  // namespace rrcb::zoltan
