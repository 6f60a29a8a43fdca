#pragma once

#include "zoltan/call/lists.hpp"
#include "zoltan/handle/state.hpp"

#include <optional>

namespace rrcb::zoltan {

/// Numbers about a partition. `num_objects` and `num_parts` are totals over all ranks.
struct Summary {
    GlobalCount num_objects = 0;
    int num_parts = 0;
    double imbalance = 0;
    bool is_measured = false;  ///< whether the imbalance was measured; otherwise it is an estimate
};

/// Result of Zoltan_LB_Partition, except its code.
struct Partition : Lists {
    bool changes = false;
    bool with_caller = false;  ///< whether the arrays are in the caller's variables already
    bool is_zoltans = false;   ///< whether the real Zoltan has to answer the call; then all else is
                               ///< empty
    std::optional<Summary> summary;  ///< empty if the call fails or the real Zoltan answers it
};

/// Answers Zoltan_LB_Partition for LB_METHOD=RRCB, or Zoltan_LB_Balance, which asks for one part
/// per rank.
///
/// `function` is the name of the function in messages. Collective over the handle's communicator;
/// returns the same code on every rank. On an error one rank prints the message, and the lists are
/// empty. `to` is written to only if Zoltan's Fortran interface is used.
int partition(Zoltan_Struct* zz, State& state, const char* function, bool one_part_per_rank,
              const CallerLists& to, Partition& result);

}  // namespace rrcb::zoltan
