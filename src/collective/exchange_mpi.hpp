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
    detail::Uninitialized<std::byte> inbox{};   ///< in the order of arrival
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
        make_outbox(order.counts(), destinations.size());
        order.for_each([write, bytes = record_bytes_, outbox = buffers_.outbox.data()](
                           std::size_t k, std::size_t place) { write(k, outbox + bytes * place); });
    }

    /// Announces the records to their ranks. Allocates memory for those to this rank, and returns
    /// their number.
    ///
    /// Collective: one reduction, which no rank leaves before all have entered it; see mpi::Tag.
    /// A rank that failed before sends nothing.
    std::size_t announce(Participant& self);

    /// Sends and receives, after the ranks agreed that all have memory.
    ///
    /// Collective: one message for each pair of ranks with records, more beyond
    /// mpi::longest_message. Throws Error if a message fails, on this rank only.
    void run(Participant& self);

    /// Calls read(source, place) for every record received: by rank, in the order written there.
    template <class Read>
    void for_each(Read&& read) const {
        for (const auto& [source, first, count] : arrived_) {
            const std::byte* place = buffers_.inbox.data() + record_bytes_ * first;
            for (std::size_t left = count; left > 0; --left, place += record_bytes_)
                read(source, place);
        }
    }

    /// Returns the memory, for another exchange; this one is over.
    ExchangeBuffers take_memory() { return std::move(buffers_); }

  private:
    /// Records of one rank in the inbox.
    struct Message {
        int source;
        std::size_t first;
        std::size_t count;
    };

    void make_outbox(std::vector<RankCount> counts, std::size_t num_records);
    std::size_t most_records() const;
    void send_all(Participant& self);
    void receive_all(Participant& self);

    std::size_t record_bytes_;
    int num_ranks_;
    std::vector<RankCount> counts_;  ///< records for each rank that gets some
    ExchangeBuffers buffers_;
    std::vector<Message> arrived_;
    std::vector<MPI_Request> requests_;
};

}  // namespace rrcb
