#pragma once

#include "collective/participant.hpp"
#include "collective/rank_order.hpp"

#include <rrcb/detail/uninitialized.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Memory for records.
struct ExchangeBuffers {
    detail::Uninitialized<std::byte> outbox{};  ///< sorted by rank
    detail::Uninitialized<std::byte> inbox{};   ///< likewise
};

/// Sends records of one size from any rank to any rank.
class Exchange {
  public:
    /// Uses the `memory` of another exchange.
    Exchange(std::size_t record_bytes, int num_ranks, ExchangeBuffers memory = {})
        : record_bytes_(record_bytes), num_ranks_(num_ranks), buffers_(std::move(memory)) {
        buffers_.outbox.clear();
        buffers_.inbox.clear();
    }

    /// Takes a record for each of `destinations`; write(k, place) writes the k-th one.
    ///
    /// Not collective. Throws std::bad_alloc; then nothing has been taken.
    template <class Write>
    void fill(std::span<const int> destinations, Write&& write) {
        RankOrder order(destinations, num_ranks_);
        buffers_.outbox.resize(record_bytes_ * destinations.size());
        to_ = order.counts();
        order.for_each([write, bytes = record_bytes_, outbox = buffers_.outbox.data()](
                           std::size_t k, std::size_t place) { write(k, outbox + bytes * place); });
    }

    /// Announces the records to their ranks. Allocates memory for those to this rank, and returns
    /// their number.
    ///
    /// Collective as exchange_counts().
    std::size_t announce(Participant& self);

    /// Sends and receives, after the ranks agreed that all have memory.
    ///
    /// Collective: one message for each pair of ranks with records, more beyond
    /// mpi::longest_message. Throws Error if a message fails, on this rank only.
    void run(Participant& self);

    /// Calls read(source, place) for every record received: by rank, in the order written there.
    template <class Read>
    void for_each(Read&& read) const {
        const std::byte* place = buffers_.inbox.data();
        for (const auto& [source, count] : from_)
            for (LocalIndex left = count; left > 0; --left, place += record_bytes_)
                read(source, place);
    }

    /// Hands the memory to another exchange. This exchange must not be used any more.
    ExchangeBuffers take_memory() { return std::move(buffers_); }

  private:
    std::size_t longest_message() const;
    template <class Begin>
    void begin_all(std::span<const RankCount> counts, Begin&& begin);

    std::size_t record_bytes_;
    int num_ranks_;
    std::vector<RankCount> to_;    ///< records for each rank that gets some
    std::vector<RankCount> from_;  ///< records of each rank that has some for this one
    ExchangeBuffers buffers_;
    std::vector<MPI_Request> requests_;
};

}  // namespace rrcb
