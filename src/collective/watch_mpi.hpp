#pragma once

#include "collective/call_log.hpp"

#include <chrono>

namespace rrcb::mpi {

/// A rank that has waited this long sleeps between two looks for its message.
inline constexpr std::chrono::milliseconds short_wait{10};

/// Gives up the processor between two looks for a message; `waited` is the time waited so far.
void pause(std::chrono::duration<double> waited);

/// Time after which a waiting rank suspects that ranks have made different calls. Tests lower it.
inline std::chrono::milliseconds patience{1000};

/// Detects why a rank waits for others in a call, and throws if they can never come.
///
/// A rank that has waited long sends its latest calls to rank 0, once. If ranks made different
/// calls, all of them wait; rank 0 then receives the calls of all and finds the difference. It
/// sends the difference to every rank, and all throw the same Error. If a rank is only late, these
/// few messages are the only cost. If a rank makes no call at all, the others wait without end.
class Watch {
  public:
    /// Ranks that the call waits for: all, or only neighbours. Exchanges with neighbours look for
    /// failures themselves.
    enum class Scope : std::uint8_t { all, neighbours };

    /// The log must outlive this object.
    explicit Watch(CallLog& log, Scope scope = Scope::all) : log_(log), scope_(scope) {}

    /// Looks once for differences and failures, then gives up the processor. Does nothing in a
    /// short wait.
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

/// Receives on rank 0 the reports of other ranks that have arrived.
void take_reports(CallLog& log);

}  // namespace rrcb::mpi
