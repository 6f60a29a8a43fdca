#pragma once

#include "zoltan/call/lists.hpp"
#include "zoltan/handle/state.hpp"

namespace rrcb::zoltan {

/// What Zoltan_LB_Partition returns beside its code.
struct Partition {
    bool changes = false;
    bool with_caller = false;  ///< the arrays are in the caller's variables already
    List imports;
    List exports;
};

/// The whole of Zoltan_LB_Partition under LB_METHOD=RRCB, or of Zoltan_LB_Balance, which is named
/// by `function` and asks for one part per rank. Collective over the handle's communicator; the
/// same code on every rank. On an error the message is printed once and the lists are empty. `to`
/// is written to only where Zoltan's Fortran interface is used.
int partition(Zoltan_Struct* zz, State& state, const char* function, bool one_part_per_rank,
              const CallerLists& to, Partition& result);

}  // namespace rrcb::zoltan
