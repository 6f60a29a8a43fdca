#pragma once

#include "zoltan/call/partition_mpi.hpp"
#include "zoltan/handle/state.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/remap.hpp>

namespace rrcb::zoltan {

Summary summary_of(const Report& report, int num_parts);

/// Prints warnings and a report line on rank 0. Not collective; lack of memory is no failure.
///
/// Warnings are for legal results that do not reach the targets; none with DEBUG_LEVEL 0. The line
/// is that of RCB_OUTPUT_LEVEL, if it is asked for.
void print_notices(const Report& report, int num_parts, const Remap& remap, const State& state,
                   const char* function) noexcept;

}  // namespace rrcb::zoltan
