#pragma once

#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Why the inputs of a call are written.
enum class DumpReason { asked, failure };

/// What the ranks together ask of the dump.
struct DumpWish {
    int rank = -1;        ///< lowest rank with RRCB_DUMP, -1: none
    bool always = false;  ///< RRCB_DUMP_WHEN is ALWAYS on a rank with RRCB_DUMP
};

/// What a partitioning call has on this rank when its inputs are to be written.
struct DumpInput {
    const char* function;
    const Points& points;
    const int* initial_parts;  ///< one per point, null when no callback tells them
    int code;
    const char* message;  ///< of an error; empty: none
};

/// Writes what the call got, where RRCB_DUMP is set on any rank and RRCB_DUMP_WHEN asks for it now.
///
/// Collective then, nothing at all otherwise. The lowest rank with a folder chooses it for all.
/// What cannot be written is warned about once, and never a reason for the call to fail.
void dump(DumpReason reason, const DumpWish& wish, const State& state,
          const DumpInput& input) noexcept;

}  // namespace rrcb::zoltan
