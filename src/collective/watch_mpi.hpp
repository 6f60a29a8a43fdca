#pragma once

#include "collective/call_log.hpp"

#include <chrono>

namespace rrcb::mpi {

/// After so long a wait a rank sleeps between two looks.
inline constexpr std::chrono::milliseconds short_wait{10};

/// Gives up the processor between two looks at a message that a rank has waited for so long.
void pause(std::chrono::duration<double> waited);

/// Time for which a rank waits before it suspects that ranks have made different calls; tests lower
/// it.
inline std::chrono::milliseconds patience{1000};

/// Looks after a rank that waits for others in a call.
///
/// A rank that has waited long sends its latest calls to rank 0, once. Ranks that made different
/// calls all wait, so rank 0 receives the calls of all and finds the difference. It sends that to
/// every rank, and all throw the same Error. A rank that is only late costs no more than these
/// messages. Ranks that make no call are waited for without end.
class Watch {
  public:
    /// Calls waited for: of all ranks, or of neighbours only, which look for failures themselves.
    enum class Scope : std::uint8_t { all, neighbours };

    /// The log outlives it.
    explicit Watch(CallLog& log, Scope scope = Scope::all) : log_(log), scope_(scope) {}

    /// Looks once, then gives up the processor; does nothing in a short wait.
    ///
    /// Throws Error if calls differ, or if a call between neighbours has failed elsewhere.
    void look();

  private:
    using Clock = std::chrono::steady_clock;

    void compare();
    [[noreturn]] void end();

    CallLog& log_;
    Scope scope_;
    Clock::time_point start_ = Clock::now();
    bool has_reported_ = false;
};

/// Receives the reports of other ranks that are there, on rank 0.
void take_reports(CallLog& log);

}  // namespace rrcb::mpi
