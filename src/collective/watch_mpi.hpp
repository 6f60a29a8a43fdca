#pragma once

#include "collective/call_log.hpp"
#include "collective/deadline_mpi.hpp"

#include <chrono>

namespace rrcb::mpi {

/// Time for which a rank waits before it suspects that ranks have made different calls; tests lower
/// it.
inline std::chrono::milliseconds patience{1000};

/// Looks after a rank that waits for others in a call.
///
/// A rank that has waited long sends its latest calls to rank 0, once. Ranks that made different
/// calls all wait, so rank 0 receives the calls of all and finds the difference. It sends that to
/// every rank, and all throw the same Error. A rank that is only late costs no more than these
/// messages.
class Watch {
  public:
    /// Calls waited for: of all ranks, or of neighbours only, which look for failures themselves.
    enum class Scope : std::uint8_t { all, neighbours };

    /// The log outlives it.
    explicit Watch(CallLog& log, Scope scope = Scope::all);

    /// Looks once, then gives up the processor; does nothing in a short wait.
    ///
    /// Throws Error if calls differ, if ranks are missing after RRCB_AGREE_SECONDS, or if a call
    /// between neighbours has failed elsewhere.
    void look();

  private:
    void compare();
    [[noreturn]] void end(CallLog::End how, std::string&& why);

    CallLog& log_;
    Scope scope_;
    Deadline deadline_;
    bool has_reported_ = false;
};

/// Returns RRCB_AGREE_SECONDS as a limit for the library's calls, by default none.
std::chrono::duration<double> agree_limit();

/// Returns the text of the error for ranks that missed a deadline.
std::string text_of_absence(const Deadline& deadline, CallName call);

/// Receives the reports of other ranks that are there, on rank 0.
void take_reports(CallLog& log);

/// Throws the Error by which an earlier call ended the use of a communicator.
[[noreturn]] void throw_end(const std::string& why);

}  // namespace rrcb::mpi
