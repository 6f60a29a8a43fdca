#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/call/vote_mpi.hpp"
#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Why the inputs of a call are written.
enum class DumpReason { asked, failure };

/// What a partitioning call has when its inputs are to be written.
struct DumpInput {
    const char* function;
    const Objects& objects;
    const LocalStatus& status;
};

/// Writes what the call got, where RRCB_DUMP is set on any rank and RRCB_DUMP_WHEN asks for it.
///
/// Collective then, nothing at all otherwise. The lowest rank with a folder chooses it for all.
/// What cannot be written is warned about once, and never a reason for the call to fail.
void dump(DumpReason reason, const Agreement& agreement, const State& state,
          const DumpInput& input) noexcept;

}  // namespace rrcb::zoltan
