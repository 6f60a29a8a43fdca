#pragma once

#include "collective/participant.hpp"
#include "zoltan/call/lists.hpp"

#include <cstdint>
#include <span>

namespace rrcb::zoltan {

/// The import lists that answer the export lists of all ranks: by rank, in the order of its list.
///
/// Collective over `self.comm`: two reductions and one message for each pair of ranks with objects.
/// `per_rank` is one number for each rank, to work with. Throws Error on all ranks where one has no
/// memory, on one alone where its message fails.
List invert(const List& exports, const Parameters& parameters, std::span<std::int64_t> per_rank,
            Participant& self);

}  // namespace rrcb::zoltan
