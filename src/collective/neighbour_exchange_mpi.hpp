#pragma once

#include "collective/call_log.hpp"
#include "collective/neighbour_link.hpp"

#include <rrcb/transfer.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace rrcb {

/// Exchanges one message with each neighbour in every call. The neighbours are a fixed set of
/// ranks; no collective call is needed. Both ranks of a pair must have each other as neighbours,
/// and make the same calls with all exchanges in the same order. Each then receives the other's
/// messages in order.
///
/// A call consists of begin(), attempt() for the steps that write the messages, run(), attempt()
/// for the steps that read them, and end(). If a call fails, it also fails on the neighbours; see
/// spread_failure_mpi.hpp. The memory of messages is kept for the next call.
class NeighbourExchange {
  public:
    /// Not collective. Throws std::bad_alloc.
    NeighbourExchange(std::vector<int> ranks, std::shared_ptr<CallLog> log);
    ~NeighbourExchange();
    NeighbourExchange(const NeighbourExchange&) = delete;
    NeighbourExchange& operator=(const NeighbourExchange&) = delete;

    std::span<const int> ranks() const { return link_.ranks; }
    const CallLog& log() const { return *log_; }

    /// Begins a call with columns. `version` must be the same on both ranks of a pair. Throws Error
    /// if an earlier call has failed.
    void begin(CallName call, std::uint64_t version = 0);

    /// Runs a step. If it throws, the call ends with this failure on this rank and on the
    /// neighbours.
    template <class Step>
    void attempt(Step&& step) {
        const Failure failure = rrcb::attempt(step);
        if (failure.failed) end_with(failure);
    }

    /// Ends the call with a failure of this rank, here and on the neighbours.
    [[noreturn]] void end_with(const Failure& failure) { fail(of_this_rank(failure)); }

    /// Sets the columns whose rows the messages contain.
    void set_types(std::span<const detail::ByteColumn> columns);

    /// Returns 16-byte aligned memory for `bytes` of a message with `rows` rows to a neighbour.
    std::byte* message_to(std::size_t neighbour, std::size_t rows, std::size_t bytes);

    /// Sends the messages and receives the neighbours' messages.
    void run();

    /// Returns whether the message of a neighbour has arrived and belongs to the same call.
    bool has_message(std::size_t neighbour) const { return incoming_[neighbour].is_valid; }
    std::size_t rows_from(std::size_t neighbour) const;
    /// Returns the message of a neighbour, 16-byte aligned.
    std::span<const std::byte> message_from(std::size_t neighbour) const {
        return std::span(incoming_[neighbour].bytes).subspan(header_bytes(types_.size()));
    }
    /// Returns the message of a neighbour. Fails unless it has this length.
    const std::byte* message_from(std::size_t neighbour, std::size_t bytes) const;

    /// Returns the number of bytes sent and received in the latest call.
    std::size_t num_bytes() const;
    /// Returns the number of bytes before the rows of a message.
    static std::size_t header_bytes(std::size_t num_columns);

    /// Ends the call. Throws the failure of a neighbour if there is one.
    void end();

  private:
    struct Incoming {
        detail::Uninitialized<std::byte> bytes{};
        bool has_arrived = false;
        bool is_valid = false;
    };
    struct Header;

    [[noreturn]] void fail(const Failure& failure);
    Failure of_this_rank(const Failure& failure) const;
    void note(const Failure& failure);
    void check(int code, const char* call);
    bool settle(std::size_t neighbour);
    void receive(std::size_t neighbour);
    bool is_notice_next(std::size_t neighbour);
    void compare(std::size_t neighbour);

    std::shared_ptr<CallLog> log_;
    NeighbourLink link_;
    std::vector<Incoming> incoming_;
    std::vector<std::uint64_t> types_;
    CallName call_ = CallName::none;
    std::uint64_t version_ = 0;
    std::uint64_t num_calls_ = 0;
    Failure failure_{};  ///< first one of this call
};

}  // namespace rrcb
