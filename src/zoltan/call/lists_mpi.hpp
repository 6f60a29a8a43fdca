#pragma once

#include "collective/participant.hpp"
#include "zoltan/call/lists.hpp"

#include <cstdint>
#include <span>

namespace rrcb::zoltan {

/// Import list that answers the export lists of all ranks: by rank, in the order of that rank's
/// list.
///
/// Collective over `self.comm`: two reductions, and a message for each pair of ranks with objects.
/// `per_rank` is scratch, one number for each rank. Throws Error on all ranks where one has no
/// memory, on one alone where its message fails.
List invert(const List& exports, const Parameters& parameters, std::span<std::int64_t> per_rank,
            Participant& self);

}  // namespace rrcb::zoltan
