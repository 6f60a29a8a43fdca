#pragma once

namespace rrcb::mpi {

/// What a message between two ranks belongs to, on the duplicate of a communicator.
///
/// Ranks run ahead of each other into the next call, so kinds are told apart by tag, and within a
/// kind two rules hold. A call receives every message that is sent to it, and names the sender:
/// MPI keeps those in order. Only an Exchange receives from any rank: none sends in it before all
/// have entered it, and none enters it that has not received all of the one before.
enum Tag : int { contribution_tag = 1, points_tag, exchange_tag };

}  // namespace rrcb::mpi
