#pragma once

#include "collective/butterfly.hpp"
#include "collective/participant.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace rrcb {

/// Carries the messages of butterflies.
class ButterflyMessages {
  public:
    /// Sends pieces of 64 kB at most. Not collective. Throws std::bad_alloc.
    ButterflyMessages();

    /// Sends pieces of as many doubles as the buffer holds, on all ranks alike; at least a head's.
    /// Not collective. Never throws. The buffer outlives it.
    explicit ButterflyMessages(std::span<double> buffer) : piece_(buffer) {}

    ButterflyMessages(const ButterflyMessages&) = delete;
    ButterflyMessages& operator=(const ButterflyMessages&) = delete;
    ButterflyMessages(ButterflyMessages&&) = default;
    ButterflyMessages& operator=(ButterflyMessages&&) = default;

    /// Runs a pass of records to their owners, or of answers back; `flags` of this rank are joined
    /// to those of all ranks in `butterfly`.
    ///
    /// Collective: ceil(log2 R) messages from each of R ranks, one more at most from some; a
    /// message that is longer than a piece takes more. No rank leaves before all have entered, as
    /// it then knows the flags of all. Throws on every rank what failed on one before the pass. A
    /// rank that fails in it goes on without records, which then are missing elsewhere as well,
    /// until the next pass or agreement tells all ranks. In the central way R - 1 messages in all;
    /// rank 0 hears in a pass to the owners of failures before or in it, which the pass back
    /// throws; `flags` count at all ranks to the owners, at rank 0 alone on the way back.
    void run(Butterfly& butterfly, Butterfly::Direction direction, Flags flags, Participant& self);

  private:
    void exchange(Butterfly& butterfly, int step, Butterfly::Direction direction,
                  const Butterfly::Link& link, Participant& self);

    std::size_t receive(std::size_t number, int from, Participant& self);

    std::unique_ptr<double[]> own_buffer_;
    std::span<double> piece_;                            ///< what came last
    std::vector<double> arrived_;                        ///< the message that it belongs to
    std::array<double, Butterfly::head_length> head_{};  ///< of this
};

}  // namespace rrcb
