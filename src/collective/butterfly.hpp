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

/// Numbers whose maximum over all ranks is known to every rank after a pass.
///
/// The first number reports failures; 0 means that there is none. Its maximum identifies the rank
/// whose failure agree() would report. The caller chooses the meaning of the others.
using Flags = std::array<double, 4>;

inline void mark_failed(Flags& flags, int rank, int num_ranks, bool may_follow = false) {
    flags[0] = std::max(flags[0], (may_follow ? 1.0 : 2.0) * num_ranks - rank);
}

/// Returns the rank whose failure is reported, or no_rank.
inline int failing_rank(const Flags& flags, int num_ranks) {
    return flags[0] > 0 ? static_cast<int>(2.0 * num_ranks - flags[0]) % num_ranks : no_rank;
}

/// Sends records of all ranks to the owners of their keys, and sends answers back. This class is
/// the part of one rank, without the messages.
///
/// The ranks are halved repeatedly, until each half has one rank; the lower half is the larger one.
/// In the step of a halving each rank sends to one rank of the other half all records whose owner
/// is there. That takes ceil(log2 R) steps for R ranks, as in the crystal router (G. C. Fox et al.:
/// Solving Problems on Concurrent Processors, volume 1, 1988). Records of one key are joined when
/// they meet. Answers take the same paths back in reverse order, to all ranks that sent or passed
/// on a record of the key.
///
/// Flags are joined in every step, so that each rank knows their maximum over all ranks after a
/// pass in either direction. Proof by induction over the halves: every rank sends its flags to a
/// rank of the other half, so after a step each half has the flags that both halves had before it.
/// This is also true if ranks fail in the pass, provided that they continue with pack_nothing().
/// The flags of the next pass then report the failure, and all ranks report the same.
///
/// The central way sends fewer messages if there are few ranks. Rank 0 owns all keys, so in each
/// step only the upper half sends, and only the lower half sends answers back: R - 1 messages in a
/// pass. After a pass to the owners only rank 0 has the flags of all ranks; the others receive the
/// flags of rank 0 on the way back.
class Butterfly {
  public:
    /// Appends to `joined` the joint payload of two records of one key. A null function means that
    /// records of one key are kept apart; then there are no answers.
    using Join = void (*)(std::span<const double> a, std::span<const double> b,
                          std::vector<double>& joined);

    enum Direction { to_owners, back };
    enum class Way { spread, central };

    /// A partner in a step, and the directions in which messages are sent. Links are used in the
    /// order of links().
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

    /// Returns the number of steps of this rank. Steps have numbers from 0; they run in ascending
    /// order to the owners, and in descending order on the way back.
    int num_steps() const { return num_steps_; }

    /// Returns the links of a step. A step number belongs to the same halving on all ranks that
    /// take part in it.
    Links links(int step, Direction direction) const;

    /// Forgets all records and answers.
    void clear();

    /// Adds a record of this rank before a pass to the owners. Keys must ascend. Throws
    /// std::bad_alloc.
    void add(Key key, int owner, std::span<const double> payload) {
        held_.append({key, owner, payload});
    }

    /// Returns the joined records of the keys that this rank owns, after a pass to the owners.
    const Records& owned() const { return held_; }

    /// Adds the answer to a key that this rank owns, before a pass back. Keys must ascend. Throws
    /// std::bad_alloc.
    void answer(Key key, std::span<const double> payload) {
        answers_.append({key, rank_, payload});
    }

    /// After a pass back, returns the answers to the records that this rank sent or passed on, in
    /// ascending order of keys.
    const Records& answers() const { return answers_; }

    /// Begins a pass with the flags of this rank. Flags of other ranks are joined from now on.
    void start(const Flags& mine) { flags_ = mine; }
    const Flags& flags() const { return flags_; }

    /// Makes the message for a link that sends. If it throws std::bad_alloc, call pack_nothing().
    void pack(int step, Direction direction, const Link& link);

    /// Makes a message without records. Never throws.
    void pack_nothing();

    /// Returns the latest message: its length in doubles, the flags, and the records.
    std::span<const double> message() const {
        return message_.empty() ? std::span<const double>(head_) : message_;
    }
    static constexpr std::size_t head_length = 1 + std::tuple_size_v<Flags>;

    /// Joins the flags of a message. Never throws.
    void hear(std::span<const double> message);

    /// Adds the records of a message from a link. Throws std::bad_alloc.
    void take(int step, Direction direction, const Link& link, std::span<const double> message);

  private:
    /// Ranks `begin` to `end` - 1, and the rank at which a step halves them.
    struct Halves {
        int begin;
        int middle;
        int end;
    };

    static constexpr Halves halves_of(int begin, int end) {
        const int length = end - begin;
        return {begin, begin + length / 2 + length % 2, end};
    }

    /// Keys of the records received from a rank: entries `begin` to `end` - 1 of keys_asked_.
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
    std::vector<double> message_;  ///< empty if the message has no records; then head_ is the
                                   ///< message
};

}  // namespace rrcb
