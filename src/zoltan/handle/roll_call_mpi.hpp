#pragma once

#include "collective/participant.hpp"

#include <mpi.h>

#include <chrono>
#include <string>
#include <vector>

namespace rrcb::zoltan {

/// Waits for all ranks of a communicator, up to a time limit, because some of them may not have the
/// plug-in.
///
/// The limit is RRCB_AGREE_SECONDS, 20 by default; 0 means that there is none. The time starts when
/// the object is made: make it when every rank is known to be in the call, so that a late rank is
/// not mistaken for one without the plug-in.
///
/// The last quarter of the limit is for the roll call: each rank in the call sends a message to all
/// others.
class RollCall {
  public:
    explicit RollCall(MPI_Comm comm);

    /// Completes a nonblocking collective call. Returns false if some ranks do not take part in it.
    /// Holds back errors of MPI in `self`.
    ///
    /// If some ranks are missing, the lowest rank with the plug-in prints which ranks have none,
    /// and all ranks with it raise MPI_ERR_OTHER on the communicator, which by default ends the
    /// program. The collective call is left pending, and its buffers must not be freed.
    bool complete(MPI_Request request, Participant& self);

  private:
    using Clock = std::chrono::steady_clock;
    using Seconds = std::chrono::duration<double>;

    Seconds waited() const { return Clock::now() - start_; }
    bool is_missed();
    void call_all();
    void call(int rank) const;
    bool receive();
    std::string absent() const;
    void report();

    MPI_Comm comm_;
    Seconds limit_;
    Seconds end_ = limit_;
    Clock::time_point start_ = Clock::now();
    std::vector<char> present_;  ///< a flag for each rank; filled in the roll call
    std::size_t num_present_ = 0;
};

}  // namespace rrcb::zoltan
