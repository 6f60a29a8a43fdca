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
    /// Runs a pass of records to their owners, or of answers back; `flags` of this rank are joined
    /// to those of all ranks in `butterfly`.
    ///
    /// Collective: ceil(log2 R) messages from each of R ranks, one more at most from some; a
    /// message longer than a piece takes several. No rank leaves before all have entered, because
    /// it needs the flags of all. Throws on every rank the failure of one before the pass. A rank
    /// that fails in the pass goes on without records. These are then missing elsewhere as well,
    /// until the next pass or agreement reports the failure.
    ///
    /// The central way has R - 1 messages in all. In a pass to the owners rank 0 learns of failures
    /// before or in it, which the pass back throws. `flags` of all ranks count on the way to the
    /// owners, on the way back only those of rank 0.
    void run(Butterfly& butterfly, Butterfly::Direction direction, Flags flags, Participant& self);

  private:
    void exchange(Butterfly& butterfly, int step, Butterfly::Direction direction,
                  const Butterfly::Link& link, Participant& self);

    std::size_t receive(std::size_t number, int from, Participant& self);

    /// Returns the memory of a piece, for at least a head and at most mpi::longest_message.
    std::span<double> piece();

    std::array<double, 8192> piece_;                     ///< the latest piece
    std::vector<double> arrived_;                        ///< the message of the latest piece
    std::array<double, Butterfly::head_length> head_{};  ///< of the message in `arrived_`
};

}  // namespace rrcb
