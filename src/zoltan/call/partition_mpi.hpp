#pragma once

#include "zoltan/call/lists.hpp"
#include "zoltan/handle/state.hpp"

#include <optional>

namespace rrcb::zoltan {

/// A partition in numbers. `num_objects` and `num_parts` are those of all ranks.
struct Summary {
    GlobalCount num_objects = 0;
    int num_parts = 0;
    double imbalance = 0;
    bool is_measured = false;  ///< otherwise estimated
};

/// Result of Zoltan_LB_Partition besides its code.
struct Partition : Lists {
    bool changes = false;
    bool with_caller = false;        ///< the arrays are in the caller's variables already
    bool is_zoltans = false;         ///< the real Zoltan is to answer the call; all else is empty
    std::optional<Summary> summary;  ///< empty if the call fails or is the real Zoltan's
};

/// Answers Zoltan_LB_Partition under LB_METHOD=RRCB, or Zoltan_LB_Balance, which asks for one part
/// per rank.
///
/// `function` is its name for messages. Collective over the handle's communicator; the same code on
/// every rank. On an error one rank prints the message, and the lists are empty. `to` is written to
/// only if Zoltan's Fortran interface is used.
int partition(Zoltan_Struct* zz, State& state, const char* function, bool one_part_per_rank,
              const CallerLists& to, Partition& result);

}  // namespace rrcb::zoltan
