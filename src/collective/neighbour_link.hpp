#pragma once

#include "collective/failure.hpp"

#include <rrcb/detail/uninitialized.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace rrcb {

/// The last message of a rank that has failed in a call between neighbours.
struct FailureNotice {
    Failure failure{};
    std::uint64_t num_sent = 0;  ///< messages of the link that its sender has sent before
};

/// Messages of a link, with the memory that MPI reads until they are received, which may be never.
struct LinkMessages {
    std::vector<detail::Uninitialized<std::byte>> messages{};  ///< one for each neighbour
    std::vector<MPI_Request> requests{};                       ///< of these
    FailureNotice notice{};
    std::vector<MPI_Request> notices{};    ///< one for each neighbour
    std::shared_ptr<LinkMessages> next{};  ///< in CallLog::undelivered
};

/// The ranks with which this one exchanges messages outside of collective calls.
struct NeighbourLink {
    std::vector<int> ranks{};     ///< ascending
    int tag = 0;                  ///< of the messages; the next one is that of notices
    std::uint64_t num_sent = 0;   ///< to each of the ranks
    std::vector<char> is_over{};  ///< whether a rank has failed
    std::shared_ptr<LinkMessages> outgoing{};
};

}  // namespace rrcb
