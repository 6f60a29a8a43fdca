#pragma once

#include "collective/participant.hpp"
#include "collective/rank_order.hpp"

#include <rrcb/detail/uninitialized.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace rrcb {

/// Memory for the records of an exchange.
struct ExchangeBuffers {
    detail::Uninitialized<std::byte> outbox{};  ///< sorted by rank
    detail::Uninitialized<std::byte> inbox{};   ///< sorted by rank
};

/// Sends records of one size from any rank to any rank.
class Exchange {
  public:
    /// Uses the memory of an earlier exchange, if it is given.
    Exchange(std::size_t record_bytes, int num_ranks, ExchangeBuffers memory = {})
        : record_bytes_(record_bytes), num_ranks_(num_ranks), buffers_(std::move(memory)) {
        buffers_.outbox.clear();
        buffers_.inbox.clear();
    }

    /// Adds a record for each entry of `destinations`; write(k, place) writes the k-th record.
    ///
    /// Not collective. If it throws std::bad_alloc, no record has been added.
    template <class Write>
    void fill(std::span<const int> destinations, Write&& write) {
        RankOrder order(destinations, num_ranks_);
        buffers_.outbox.resize(record_bytes_ * destinations.size());
        to_ = order.counts();
        order.for_each([write, bytes = record_bytes_, outbox = buffers_.outbox.data()](
                           std::size_t k, std::size_t place) { write(k, outbox + bytes * place); });
    }

    /// Announces the number of records to their ranks. Allocates memory for the records that this
    /// rank receives, and returns their number.
    ///
    /// Collective in the same way as exchange_counts().
    std::size_t announce(Participant& self);

    /// Sends and receives. Before, the ranks must have agreed that all of them have memory.
    ///
    /// Collective: one message for each pair of ranks with records, or more if it is longer than
    /// mpi::longest_message. If a message fails, throws Error on this rank only.
    void run(Participant& self);

    /// Calls read(source, place) for every received record: ordered by rank, then in the order of
    /// writing.
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
    std::vector<RankCount> to_;    ///< number of records for each rank that gets some
    std::vector<RankCount> from_;  ///< number of records from each rank that sends some
    ExchangeBuffers buffers_;
    std::vector<MPI_Request> requests_;
};

}  // namespace rrcb
