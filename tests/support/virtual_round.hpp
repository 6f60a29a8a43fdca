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

/// Calls work(begin, end) for the two halves of what lies between, where it is much on two threads;
/// joins what they return.
template <class Work>
MessageTotals by_halves(int begin, int end, Work&& work) {
    constexpr int least_for_threads = 2048;
    const int middle = begin + (end - begin + 1) / 2;
    const auto policy =
        end - begin >= least_for_threads ? std::launch::async : std::launch::deferred;
    auto below = std::async(policy, [&] { return work(begin, middle); });
    MessageTotals totals = work(middle, end);
    totals.join(below.get());
    return totals;
}

/// A round of all ranks: records to their owners, who answer, and the answers back.
///
/// It goes half by half: the lower half takes all of its steps before the upper one begins, or
/// beside it on another thread; and within a half a few ranks take several steps before others
/// begin, so that what a cache holds serves many steps. No rank can tell.
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
          steps_(bytes_into_.size()),
          totals_(run_all(ranks.num_ranks())) {}

    const MessageTotals& totals() const { return totals_; }

    /// Into each rank, in both passes.
    const std::vector<std::size_t>& bytes_into() const { return bytes_into_; }

  private:
    static constexpr int steps_at_once = 4;

    /// Once it returns, each rank knows what one of them knew.
    MessageTotals run_all(int num_ranks) {
        if (num_ranks == 1) return run(0, 0, num_ranks);
        // Every link of a step has one end in the upper half, and no rank of the lower half has
        // two.
        const int middle = (num_ranks + 1) / 2;
        MessageTotals totals;
        totals.join(by_halves(middle, num_ranks, [&](int first, int last) {
            return go(Butterfly::to_owners, 1, first, last);
        }));
        totals.join(
            by_halves(0, num_ranks, [&](int first, int last) { return run(1, first, last); }));
        totals.join(by_halves(middle, num_ranks, [&](int first, int last) {
            return go(Butterfly::back, 0, first, last);
        }));
        return totals;
    }

    /// The same for the ranks from `begin` to `end`, which a step less have parted from others.
    MessageTotals run(int step, int begin, int end) {
        MessageTotals totals;
        if (end - begin == 1) {
            ranks_.run(begin, [&] { ranks_.turn(begin); });
            return totals;
        }
        totals.join(go(Butterfly::to_owners, step + steps_at_once, begin, end));
        totals.join(run_pieces(step, step + steps_at_once, begin, end));
        totals.join(go(Butterfly::back, step, begin, end));
        return totals;
    }

    /// Runs what is left of each piece of the ranks that steps up to `last` have parted.
    MessageTotals run_pieces(int step, int last, int begin, int end) {
        if (step == last || end - begin == 1) return run(step, begin, end);
        const int middle = begin + (end - begin + 1) / 2;
        MessageTotals totals = run_pieces(step + 1, last, begin, middle);
        totals.join(run_pieces(step + 1, last, middle, end));
        return totals;
    }

    /// Brings ranks to a step.
    MessageTotals go(Butterfly::Direction direction, int step, int begin, int end) {
        MessageTotals totals;
        // From above, as an exchange begins from the upper one of two ranks.
        for (int rank = end; rank-- > begin;) bring(rank, step, direction, totals);
        return totals;
    }

    /// Brings a rank to a step, and before each exchange those that it takes part in.
    void bring(int rank, int goal, Butterfly::Direction direction, MessageTotals& totals) {
        const bool is_there = direction == Butterfly::to_owners;
        goal = std::min(goal, ranks_.butterfly(rank).num_steps());
        while (is_there ? step_of(rank) < goal : step_of(rank) > goal) {
            const int before = step_of(rank);
            const int step = is_there ? before : before - 1;
            Butterfly::Links links = ranks_.butterfly(rank).links(step, direction);
            const int upper = std::max(rank, links.links[0].rank);
            if (upper != rank) links = ranks_.butterfly(upper).links(step, direction);
            bring(upper, before, direction, totals);
            for (const auto& link : links) bring(link.rank, before, direction, totals);
            for (const auto& link : links) exchange(upper, step, direction, link, totals);
            const int after = is_there ? step + 1 : step;
            step_of(upper) = static_cast<std::int8_t>(after);
            for (const auto& link : links) step_of(link.rank) = static_cast<std::int8_t>(after);
        }
    }

    void exchange(int rank, int step, Butterfly::Direction direction, const Butterfly::Link& link,
                  MessageTotals& totals) {
        const Butterfly::Link reverse{rank, link.receives, link.sends};
        if (link.sends) pack(rank, step, direction, link);
        if (link.receives) pack(link.rank, step, direction, reverse);
        if (link.sends) deliver(rank, step, direction, reverse, link.rank, totals);
        if (link.receives) deliver(link.rank, step, direction, link, rank, totals);
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

    std::int8_t& step_of(int rank) { return steps_[static_cast<std::size_t>(rank)]; }

    Ranks& ranks_;
    std::vector<std::size_t> bytes_into_;
    std::vector<std::int8_t>
        steps_;  ///< that each rank is to take next, or took last on the way back
    MessageTotals totals_;
};

}  // namespace rrcb::test
