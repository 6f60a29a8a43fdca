#pragma once

#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// Reason to write the inputs of a call.
enum class DumpReason { asked, failure };

/// Dumps that all ranks together ask for.
struct DumpWish {
    int rank = -1;        ///< lowest rank with RRCB_DUMP, -1: none
    bool always = false;  ///< RRCB_DUMP_WHEN is ALWAYS on a rank with RRCB_DUMP
};

/// Inputs of a partitioning call on this rank.
struct DumpInput {
    const char* function;
    const Points& points;
    const int* initial_parts;  ///< one per point, null without a callback for them
    int code;
    const char* message;  ///< of an error; empty: none
};

/// Writes the inputs of a call if RRCB_DUMP is set on any rank and RRCB_DUMP_WHEN asks for it now.
///
/// Collective in that case, else does nothing. The lowest rank with a folder chooses it for all. A
/// failure to write is warned about once, and never fails the call.
void dump(DumpReason reason, const DumpWish& wish, const State& state,
          const DumpInput& input) noexcept;

}  // namespace rrcb::zoltan
