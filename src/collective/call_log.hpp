#pragma once

#include "collective/neighbour_link.hpp"

#include <mpi.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rrcb {

/// A collective function of the library.
enum class CallName : std::uint8_t {
    none,
    balance,
    balance_as_in_paper,
    plan,
    remap,
    transfer,
    ghost_plan,
    fetch,
    accumulate,
    groups,
    fetch_from_groups,
    sums,
    part_weights,
    moved_fraction,
    assign,
    create,
    controller,
    controller_step,
    cost_model,
    cost_model_step,
    verify,
    save,
    load,
    join_keys,
    reply,
    neighbours,
    migrate,
    find_ghosts,
    fetch_of_neighbours,
    accumulate_of_neighbours,
    sum,
    fail_of_neighbours,
    kept_fetch,
    kept_accumulate,
    kept_reply
};
inline constexpr int most_call_names = 40;

/// Returns the name by which users know a function.
std::string_view name_of(CallName call);

/// The latest calls of a rank with one communicator, as sent to other ranks.
class CallRecord {
  public:
    static constexpr std::uint32_t num_kept = 16;

    void add(CallName call) { calls_[number_++ % num_kept] = call; }

    /// Returns the total number of calls.
    std::uint32_t number() const { return number_; }

    /// Returns the call with a number (from 0), which must be one of the latest num_kept.
    CallName call(std::uint32_t number) const { return calls_[number % num_kept]; }
    CallName latest() const { return number_ > 0 ? call(number_ - 1) : CallName::none; }

  private:
    std::uint32_t number_ = 0;
    std::array<CallName, num_kept> calls_{};
};

/// Two ranks that made different calls.
struct CallDifference {
    std::array<int, 2> ranks{};
    std::array<CallName, 2> calls{};
};

/// Returns the first difference between the calls of all ranks: that of rank 0 and of the lowest
/// rank with another call. If there is none, returns the first difference from the rank with the
/// fewest calls. Returns nullopt if the calls of some rank are not known yet.
std::optional<CallDifference> find_different_calls(std::span<const CallRecord> known);

std::string text_of(const CallDifference& difference);

/// The collective calls on one duplicate of the library. A call starts with a meeting, in which
/// each rank waits for all others. Only after the meeting can a rank rely on the others being in
/// the same call.
struct CallLog {
    enum class End : std::uint8_t {
        none,
        differed,  ///< ranks made different calls; the next call makes another duplicate
        failed     ///< a call that waits only for neighbours failed; the next call makes another
                   ///< duplicate
    };

    MPI_Comm comm = MPI_COMM_NULL;  ///< the duplicate; null once it is freed
    /// Identifies the processes of `comm` and their order; equal for congruent communicators only.
    /// Never 0 in a call.
    std::uint64_t group = 0;
    CallRecord mine{};
    bool is_meeting = false;  ///< the latest call has not met the other ranks yet
    End end = End::none;
    std::string why{};                ///< text of the error that ended the use of the duplicate
    std::vector<CallRecord> known{};  ///< of all ranks, on rank 0
    /// Messages under way, which may never be received.
    CallRecord sent{};
    CallDifference verdict{};
    FailureNotice notice{};
    std::shared_ptr<LinkMessages> undelivered{};
    std::shared_ptr<CallLog> ended_before{};  ///< another log that has ended

    std::vector<NeighbourLink*> links{};  ///< all exchanges between neighbours that exist

    /// Notes a call without a meeting, in which the rank waits only for messages of the call
    /// itself.
    void add(CallName call) { mine.add(call); }

    /// Notes a call that begins with a meeting.
    void begin(CallName call) {
        add(call);
        is_meeting = comm != MPI_COMM_NULL;
    }

    /// Returns the tag of a kind of message in the current call. It differs from the tags of other
    /// calls.
    int tag(int kind) const;
};

}  // namespace rrcb
