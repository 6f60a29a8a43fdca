// Rounds of butterflies on a great many virtual ranks, in one process.
#pragma once

#include "collective/butterfly.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <future>
#include <span>
#include <vector>

namespace rrcb::test {

/// What messages amounted to.
struct MessageTotals {
    std::int64_t messages = 0;
    std::int64_t bytes = 0;
    std::vector<std::array<std::size_t, 2>> longest{};  ///< by step and direction, in bytes

    void add(int step, Butterfly::Direction direction, std::size_t size) {
        ++messages;
        bytes += static_cast<std::int64_t>(size);
        const auto depth = static_cast<std::size_t>(step);
        if (depth >= longest.size()) longest.resize(depth + 1);
        longest[depth][direction] = std::max(longest[depth][direction], size);
    }

    void join(const MessageTotals& other) {
        messages += other.messages;
        bytes += other.bytes;
        longest.resize(std::max(longest.size(), other.longest.size()));
        for (std::size_t k = 0; k < other.longest.size(); ++k)
            for (std::size_t way = 0; way < 2; ++way)
                longest[k][way] = std::max(longest[k][way], other.longest[k][way]);
    }
};

/// A round of all ranks: records to their owners, who answer, and the answers back.
///
/// It goes half by half: the lower half takes all of its steps before the upper one begins, or
/// beside it on another thread, so that what a cache holds serves many steps. No rank can tell.
///
/// `Ranks` has num_ranks(); butterfly(rank), which has started a pass to the owners; turn(rank),
/// which answers what the rank owns and starts it on the way back; and run(rank, step), which runs
/// a step that is that rank's.
template <class Ranks>
class VirtualRound {
  public:
    explicit VirtualRound(Ranks& ranks)
        : ranks_(ranks),
          bytes_into_(static_cast<std::size_t>(ranks.num_ranks())),
          totals_(run(0, 0, ranks.num_ranks())) {}

    const MessageTotals& totals() const { return totals_; }

    /// Into each rank, in both passes.
    const std::vector<std::size_t>& bytes_into() const { return bytes_into_; }

  private:
    static constexpr int steps_on_two_threads = 1;
    static constexpr int least_for_threads = 4096;

    /// Once it returns, each of the ranks from `begin` to `end` knows what one of them knew.
    MessageTotals run(int step, int begin, int end) {
        MessageTotals totals;
        if (end - begin == 1) {
            ranks_.run(begin, [&] { ranks_.turn(begin); });
            return totals;
        }
        const int middle = begin + (end - begin + 1) / 2;
        exchange(step, Butterfly::to_owners, middle, end, totals);
        if (step < steps_on_two_threads && end - begin >= least_for_threads) {
            auto below =
                std::async(std::launch::async, [&] { return run(step + 1, begin, middle); });
            totals.join(run(step + 1, middle, end));
            totals.join(below.get());
        } else {
            totals.join(run(step + 1, begin, middle));
            totals.join(run(step + 1, middle, end));
        }
        exchange(step, Butterfly::back, middle, end, totals);
        return totals;
    }

    /// Every link of a step has one end in the upper half.
    void exchange(int step, Butterfly::Direction direction, int middle, int end,
                  MessageTotals& totals) {
        for (int rank = middle; rank < end; ++rank) {
            for (const Butterfly::Link& link : ranks_.butterfly(rank).links(step, direction)) {
                const Butterfly::Link reverse{rank, link.receives, link.sends};
                if (link.sends) pack(rank, step, direction, link);
                if (link.receives) pack(link.rank, step, direction, reverse);
                if (link.sends) deliver(rank, step, direction, reverse, link.rank, totals);
                if (link.receives) deliver(link.rank, step, direction, link, rank, totals);
            }
        }
    }

    void pack(int rank, int step, Butterfly::Direction direction, const Butterfly::Link& link) {
        ranks_.run(rank, [&] { ranks_.butterfly(rank).pack(step, direction, link); });
    }

    void deliver(int from, int step, Butterfly::Direction direction, const Butterfly::Link& link,
                 int to, MessageTotals& totals) {
        const std::span<const double> message = ranks_.butterfly(from).message();
        ranks_.run(to, [&] {
            ranks_.butterfly(to).hear(message);
            ranks_.butterfly(to).take(step, direction, link, message);
        });
        totals.add(step, direction, message.size_bytes());
        bytes_into_[static_cast<std::size_t>(to)] += message.size_bytes();
    }

    Ranks& ranks_;
    std::vector<std::size_t> bytes_into_;
    MessageTotals totals_;
};

}  // namespace rrcb::test
