#pragma once

#include "collective/deadline_mpi.hpp"
#include "collective/participant.hpp"

#include <mpi.h>

namespace rrcb::zoltan {

/// Waits for all ranks of a communicator, of which some may lack the plug-in, up to a time limit.
///
/// The limit is RRCB_AGREE_SECONDS, 20 by default; 0 means none. The clock starts with the object:
/// make it when every rank is known to be in the call, so that a late rank is not taken for one
/// without the plug-in.
class RollCall {
  public:
    explicit RollCall(MPI_Comm comm);

    /// Completes a nonblocking collective call. Returns false if some ranks take no part in it.
    ///
    /// Then the lowest rank with the plug-in prints which ranks have none, and all ranks with it
    /// raise MPI_ERR_OTHER on the communicator: by default that ends the program. The collective
    /// call is left pending, and its buffers must stay.
    bool complete(MPI_Request request, Participant& self);

  private:
    void report();

    MPI_Comm comm_;
    Deadline deadline_;
};

}  // namespace rrcb::zoltan
