#pragma once

#include "collective/failure.hpp"

#include <rrcb/detail/uninitialized.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace rrcb {

/// The last message of a rank that has failed in a call between neighbours. By its length it
/// differs from all others, which are multiples of 16 bytes.
using FailureNotice = Failure;
static_assert(sizeof(FailureNotice) % 16 != 0);

/// Messages to neighbours, with the memory that MPI reads until they are received, which may be
/// never.
struct LinkMessages {
    std::vector<detail::Uninitialized<std::byte>> messages{};  ///< one for each neighbour
    std::vector<MPI_Request> requests{};                       ///< of these
    std::shared_ptr<LinkMessages> next{};                      ///< in CallLog::undelivered
};

/// The ranks with which this one exchanges messages outside of collective calls.
struct NeighbourLink {
    std::vector<int> ranks{};     ///< ascending
    std::vector<char> is_over{};  ///< whether a rank is known to have failed
    std::shared_ptr<LinkMessages> outgoing{};
};

}  // namespace rrcb
