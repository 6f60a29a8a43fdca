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
    ghosts,
    fetch,
    accumulate,
    groups,
    fetch_from_groups,
    sums,
    part_weights,
    moved_fraction,
    assign_all,
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

    /// Returns the number of calls so far.
    std::uint32_t number() const { return number_; }

    /// Returns the call with a number from 0, one of those kept.
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

/// Returns the first difference between the calls of all ranks: those of rank 0 and of the lowest
/// rank with another call, or, if there is none, of the rank with the fewest calls. Returns nullopt
/// if calls of some rank are not known yet.
std::optional<CallDifference> find_different_calls(std::span<const CallRecord> known);

std::string text_of(const CallDifference& difference);

/// The calls with a duplicate of the library's. A call starts with a meeting, in which each rank
/// waits for all others; only then do ranks depend on each other's arguments.
struct CallLog {
    enum class End : std::uint8_t {
        none,
        differed,  ///< ranks made different calls: the next call makes another duplicate
        failed     ///< a call that waits only for neighbours failed: likewise
    };

    MPI_Comm comm = MPI_COMM_NULL;  ///< the duplicate; null once it is freed
    /// Number of the processes of `comm` and their order, never 0 in a call: the same for congruent
    /// communicators, otherwise another one.
    std::uint64_t group = 0;
    CallRecord mine{};
    bool is_meeting = false;  ///< the latest call has not met the other ranks yet
    End end = End::none;
    std::string why{};                ///< text of the error that ended it
    std::vector<CallRecord> known{};  ///< of all ranks, on rank 0
    /// Messages under way, which no rank may ever receive.
    CallRecord sent{};
    CallDifference verdict{};
    FailureNotice notice{};
    std::shared_ptr<LinkMessages> undelivered{};
    std::shared_ptr<CallLog> ended_before{};  ///< another log that has ended

    std::vector<NeighbourLink*> links{};  ///< exchanges between neighbours that exist

    /// Notes a call that waits in the other messages of its own only.
    void add(CallName call) { mine.add(call); }

    /// Notes a call that begins with a meeting.
    void begin(CallName call) {
        add(call);
        is_meeting = comm != MPI_COMM_NULL;
    }

    /// Returns the tag by which a kind of message meets only those of the same call.
    int tag(int kind) const;
};

}  // namespace rrcb
