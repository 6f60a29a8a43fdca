#pragma once

#include "collective/failure.hpp"

#include <rrcb/detail/uninitialized.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace rrcb {

/// Last message of a rank that has failed in a call between neighbours. It is recognized by its
/// length: all other messages are multiples of 16 bytes long.
using FailureNotice = Failure;
static_assert(sizeof(FailureNotice) % 16 != 0);

/// Messages to neighbours, with their memory. MPI reads this memory until the messages are
/// received, which may never happen.
struct LinkMessages {
    std::vector<detail::Uninitialized<std::byte>> messages{};  ///< one for each neighbour
    std::vector<MPI_Request> requests{};                       ///< one for each message
    std::shared_ptr<LinkMessages> next{};  ///< next entry of the list CallLog::undelivered
};

/// The ranks with which this one exchanges messages outside of collective calls.
struct NeighbourLink {
    std::vector<int> ranks{};     ///< ascending
    std::vector<char> is_over{};  ///< whether a rank is known to have failed
    std::shared_ptr<LinkMessages> outgoing{};
};

}  // namespace rrcb
