#pragma once

#include "collective/failure.hpp"
#include "collective/records.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <vector>

namespace rrcb {

/// Numbers whose maximum over the ranks all know after a pass.
///
/// The first is for failures, 0 for none: its maximum names the rank whose failure agree() would
/// report. The caller chooses the meaning of the others.
using Flags = std::array<double, 4>;

inline void mark_failed(Flags& flags, int rank, int num_ranks, bool may_follow = false) {
    flags[0] = std::max(flags[0], (may_follow ? 1.0 : 2.0) * num_ranks - rank);
}

/// Returns the rank whose failure is reported, or no_rank.
inline int failing_rank(const Flags& flags, int num_ranks) {
    return flags[0] > 0 ? static_cast<int>(2.0 * num_ranks - flags[0]) % num_ranks : no_rank;
}

/// Sends records of all ranks to the owners of their keys, and answers back: the part of one rank,
/// without the messages.
///
/// The ranks are halved again and again, the lower half being the larger one, until each is alone.
/// In the step of a halving a rank sends one rank of the other half all records whose owner is
/// there: ceil(log2 R) steps for R ranks, as in the crystal router (G. C. Fox et al.: Solving
/// Problems on Concurrent Processors, volume 1, 1988). Records of one key are joined when they
/// meet. Answers take the same paths back, in reverse order, to all ranks that sent or passed on a
/// record of the key.
///
/// Flags are joined in every step, so each rank knows the largest of all ranks after a pass in
/// either direction. Proof by induction over the halves: every rank sends its flags to one of the
/// other half, so after a step a half knows what both halves knew before it. This also holds if
/// ranks fail on the way, provided that they go on with pack_nothing(). The flags of the next pass
/// then report the failure, the same on all ranks.
///
/// The central way has fewer messages for few ranks: rank 0 owns all keys, so the upper half of
/// each halving sends to the lower one, and receives from it on the way back: R - 1 messages a
/// pass. After a pass to the owners only rank 0 knows the flags of all; the others receive those of
/// rank 0 on the way back.
class Butterfly {
  public:
    /// Appends the payload that `a` and `b` of one key make together. Null if records of one key
    /// stay apart; then there are no answers.
    using Join = void (*)(std::span<const double> a, std::span<const double> b,
                          std::vector<double>& joined);

    enum Direction { to_owners, back };
    enum class Way { spread, central };

    /// A partner in a step and the directions of its messages; links are used in this order.
    struct Link {
        int rank;
        bool sends;     ///< to that rank
        bool receives;  ///< from the same rank
    };
    struct Links {
        std::array<Link, 2> links;
        std::size_t count;

        const Link* begin() const { return links.data(); }
        const Link* end() const { return links.data() + count; }
    };

    /// Not collective. Never throws.
    Butterfly(int rank, int num_ranks, Join join, Way way = Way::spread);

    int rank() const { return rank_; }
    int num_ranks() const { return num_ranks_; }
    bool is_central() const { return way_ == Way::central; }

    /// Returns the number of steps of this rank. They are numbered from 0 on the way to the owners,
    /// and run in reverse order on the way back.
    int num_steps() const { return num_steps_; }

    /// The same step means the same halving on all ranks in it.
    Links links(int step, Direction direction) const;

    /// Forgets all records and answers.
    void clear();

    /// Adds a record of this rank before a pass to the owners; keys ascend. Throws std::bad_alloc.
    void add(Key key, int owner, std::span<const double> payload) {
        held_.append({key, owner, payload});
    }

    /// Returns the joined records of the keys that this rank owns, after a pass to the owners.
    const Records& owned() const { return held_; }

    /// Adds the answer to a key that this rank owns before a pass back; keys ascend. Throws
    /// std::bad_alloc.
    void answer(Key key, std::span<const double> payload) {
        answers_.append({key, rank_, payload});
    }

    /// Returns the answers to the records of this rank, and to those that it passed on, after a
    /// pass back; ascending by key.
    const Records& answers() const { return answers_; }

    /// Begins a pass. From this call on flags() are joined.
    void start(const Flags& mine) { flags_ = mine; }
    const Flags& flags() const { return flags_; }

    /// Makes the message for a link that sends. Throws std::bad_alloc; then call pack_nothing().
    void pack(int step, Direction direction, const Link& link);

    /// Makes a message without records. Never throws.
    void pack_nothing();

    /// Returns the message that was made: its number of doubles, the flags, and records.
    std::span<const double> message() const {
        return message_.empty() ? std::span<const double>(head_) : message_;
    }
    static constexpr std::size_t head_length = 1 + std::tuple_size_v<Flags>;

    /// Joins the flags of a message. Never throws.
    void hear(std::span<const double> message);

    /// Adds the records of a message from a link. Throws std::bad_alloc.
    void take(int step, Direction direction, const Link& link, std::span<const double> message);

  private:
    /// The ranks from `begin` to `end` as they are halved in a step.
    struct Halves {
        int begin;
        int middle;
        int end;
    };

    static constexpr Halves halves_of(int begin, int end) {
        const int length = end - begin;
        return {begin, begin + length / 2 + length % 2, end};
    }

    /// Keys of the records from a rank: entries `begin` to `end` - 1 of keys_asked_.
    struct Asked {
        int step;
        int rank;
        std::size_t begin;
        std::size_t end;
    };

    Halves halves_at(int step) const;
    void hand_over(int step);
    void reply(int step, int rank);
    void append_to_message(const Record& record);
    void note_asked(int step, int rank, RecordReader incoming);
    Records merged(RecordReader mine, RecordReader others) const;

    int rank_;
    int num_ranks_;
    Join join_;
    Way way_;
    int num_steps_ = 0;
    Flags flags_{};
    Records held_;
    Records answers_;
    std::vector<Asked> asked_;
    std::vector<Key> keys_asked_;
    std::array<double, head_length> head_{};
    std::vector<double> message_;  ///< empty if the message is only its head
};

}  // namespace rrcb
