#pragma once

#include "collective/butterfly.hpp"
#include "collective/participant.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rrcb {

/// Sends and receives the messages of butterflies.
class ButterflyMessages {
  public:
    /// Runs a pass of records to their owners, or of answers back. Joins the flags of this rank
    /// with those of all ranks in `butterfly`.
    ///
    /// Collective: each of R ranks sends ceil(log2 R) messages, and some send one more; a message
    /// longer than a piece is sent in several. No rank returns before all ranks have entered,
    /// because it needs the flags of all. If a rank failed before the pass, every rank throws its
    /// failure. If a rank fails in the pass, it continues without records: those are then missing
    /// on other ranks as well, until the next pass or agreement reports the failure.
    ///
    /// The central way sends R - 1 messages in all. In a pass to the owners only rank 0 learns of
    /// failures, before or in the pass; the pass back throws them on all ranks. On the way to the
    /// owners the flags of all ranks are joined, on the way back only those of rank 0 are
    /// distributed.
    void run(Butterfly& butterfly, Butterfly::Direction direction, Flags flags, Participant& self);

  private:
    void exchange(Butterfly& butterfly, int step, Butterfly::Direction direction,
                  const Butterfly::Link& link, Participant& self);

    std::size_t receive(std::size_t number, int from, Participant& self);

    /// Returns the memory of a piece: at least a head long, and at most mpi::longest_message.
    std::span<double> piece();

    std::array<double, 8192> piece_;                     ///< the latest piece
    std::vector<double> arrived_;                        ///< the message of the latest piece
    std::array<double, Butterfly::head_length> head_{};  ///< of the message in `arrived_`
};

}  // namespace rrcb
