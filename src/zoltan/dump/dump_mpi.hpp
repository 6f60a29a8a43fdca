#pragma once

#include "zoltan/dump/dump_files.hpp"

namespace rrcb::zoltan {

/// Reason to write the inputs of a call.
enum class DumpReason { asked, failure };

/// Dumps, as all ranks together ask for.
struct DumpWish {
    int rank = -1;        ///< lowest rank with RRCB_DUMP, -1: none
    bool always = false;  ///< RRCB_DUMP_WHEN is ALWAYS on a rank with RRCB_DUMP
};

/// Writes the inputs of a call if RRCB_DUMP is set on any rank and RRCB_DUMP_WHEN asks for it now.
///
/// Collective in that case, else does nothing. The lowest rank with a folder chooses it for all. A
/// failure to write is warned about once, and never fails the call.
void dump(DumpReason reason, const DumpWish& wish, const State& state,
          const DumpInput& input) noexcept;

}  // namespace rrcb::zoltan
