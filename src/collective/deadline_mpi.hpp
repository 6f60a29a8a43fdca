#pragma once

#include "collective/participant.hpp"

#include <mpi.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace rrcb {

/// Returns RRCB_AGREE_SECONDS of the environment, NaN if it is not a number of seconds, nullopt if
/// it is not set.
std::optional<double> agree_seconds();

/// After so long a wait a rank sleeps between two looks.
inline constexpr std::chrono::milliseconds short_wait{10};

/// Gives up the processor between two looks at a message that a rank has waited for so long.
void pause(std::chrono::duration<double> waited);

/// Time limit for all ranks of a communicator to take part in a call, and the roll call that finds
/// which do not.
///
/// The last quarter of the limit serves for the roll call: the ranks in the call send a message
/// each to all others. The clock starts with the object.
class Deadline {
  public:
    /// `limit` 0 means none. If it `answers`, it calls the roll as soon as another rank does, so
    /// that a late rank is not missed; then the tag is the library's own.
    Deadline(MPI_Comm comm, int tag, std::chrono::duration<double> limit, bool answers);

    /// Completes a nonblocking collective call. Returns false if some ranks take no part in it;
    /// then the call is left pending, and its buffers must stay. Holds back errors of MPI in
    /// `self`.
    bool complete(MPI_Request& request, Participant& self);

    /// Returns true if some ranks take no part. If all do, some only being slow, there is no limit
    /// any more. Not collective. Never throws; without memory there is no limit.
    bool is_missed();

    std::chrono::duration<double> waited() const { return Clock::now() - start_; }
    std::chrono::duration<double> limit() const { return limit_; }

    /// Returns a flag for each rank, after a roll call.
    const std::vector<char>& present() const { return present_; }

    /// Returns "0, 2-5 of 8": the ranks that take no part.
    std::string absent() const;

    /// Sends the message of the roll call to a rank.
    void call(int rank) const;

  private:
    using Clock = std::chrono::steady_clock;

    bool receive();
    void call_all();

    MPI_Comm comm_;
    int tag_;
    std::chrono::duration<double> limit_;
    bool answers_;
    Clock::time_point start_ = Clock::now();
    std::chrono::duration<double> end_;
    std::vector<char> present_;
    std::size_t num_present_ = 0;
};

}  // namespace rrcb
