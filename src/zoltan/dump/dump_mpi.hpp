#pragma once

#include "zoltan/dump/dump_files.hpp"

namespace rrcb::zoltan {

/// Reason for writing the inputs of a call.
enum class DumpReason { asked, failure };

/// What all ranks together ask to dump.
struct DumpWish {
    int rank = -1;        ///< lowest rank with RRCB_DUMP; -1 if there is none
    bool always = false;  ///< whether RRCB_DUMP_WHEN is ALWAYS on a rank with RRCB_DUMP
};

/// Writes the inputs of a call if RRCB_DUMP is set on any rank and RRCB_DUMP_WHEN includes this
/// reason.
///
/// Collective if it writes; otherwise does nothing. The lowest rank with a folder chooses it for
/// all ranks. If writing fails, it warns once; the call does not fail because of it.
void dump(DumpReason reason, const DumpWish& wish, const State& state,
          const DumpInput& input) noexcept;

}  // namespace rrcb::zoltan
