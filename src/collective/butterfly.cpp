#include "collective/butterfly.hpp"

#include <algorithm>

namespace rrcb {

Butterfly::Butterfly(int rank, int num_ranks, Join join, Way way)
    : rank_(rank), num_ranks_(num_ranks), join_(join), way_(way) {
    const auto goes_on = [way](const Halves& halves) {
        return halves.end - halves.begin > 1 && (way == Way::spread || halves.begin == 0);
    };
    while (goes_on(halves_at(num_steps_))) ++num_steps_;
}

Butterfly::Halves Butterfly::halves_at(int step) const {
    Halves halves = halves_of(0, num_ranks_);
    // Keeps the half that contains this rank. The loop has no branches, because they would be
    // unpredictable.
    for (; step > 0; --step) {
        const bool is_below = rank_ < halves.middle;
        halves = halves_of(is_below ? halves.begin : halves.middle,
                           is_below ? halves.middle : halves.end);
    }
    return halves;
}

Butterfly::Links Butterfly::links(int step, Direction direction) const {
    const Halves halves = halves_at(step);
    const int mirror = halves.begin + (halves.end - 1 - rank_);
    const bool to = direction == to_owners;
    if (is_central()) {
        const bool sends = to == (rank_ >= halves.middle);
        return {{Link{mirror, sends, !sends}}, mirror == rank_ ? 0U : 1U};
    }
    // If the number of ranks is odd, the last rank of the lower half has no partner: it sends its
    // records to the first rank of the other half, and receives none.
    if (mirror == rank_) return {{Link{halves.middle, to, !to}}, 1};
    const bool is_odd = (halves.end - halves.begin) % 2 != 0;
    return {{Link{mirror, true, true}, Link{rank_ - 1, !to, to}},
            is_odd && rank_ == halves.middle ? 2U : 1U};
}

void Butterfly::clear() {
    held_.clear();
    answers_.clear();
    asked_.clear();
    keys_asked_.clear();
}

void Butterfly::pack_nothing() {
    message_.clear();
    head_[0] = head_length;
    std::ranges::copy(flags_, head_.begin() + 1);
}

void Butterfly::pack(int step, Direction direction, const Link& link) {
    pack_nothing();
    if (direction == to_owners) {
        hand_over(step);
    } else {
        reply(step, link.rank);
    }
    if (!message_.empty()) message_[0] = static_cast<double>(message_.size());
}

void Butterfly::append_to_message(const Record& record) {
    if (message_.empty()) message_.assign(head_.begin(), head_.end());
    append_record(message_, record);
}

/// Moves the records whose owner is in the other half into the message.
void Butterfly::hand_over(int step) {
    const Halves own = halves_at(step + 1);
    const auto stays_here = [&](const Record& record) {
        return own.begin <= record.owner && record.owner < own.end;
    };
    held_.for_each([&](const Record& record) {
        if (!stays_here(record)) append_to_message(record);
    });
    // Usually no record is handed over, because points are near the ranks of their parts.
    if (!message_.empty()) held_.keep(stays_here);
}

/// Adds to the message the answers to the records that a rank sent in this step.
void Butterfly::reply(int step, int rank) {
    const auto asked = std::ranges::find_if(
        asked_, [&](const Asked& one) { return one.step == step && one.rank == rank; });
    if (asked == asked_.end()) return;
    const std::span keys(keys_asked_.begin() + asked->begin, keys_asked_.begin() + asked->end);
    answers_.for_each([&](const Record& answer) {
        if (std::ranges::binary_search(keys, answer.key)) append_to_message(answer);
    });
}

void Butterfly::hear(std::span<const double> message) {
    for (std::size_t k = 0; k < flags_.size(); ++k) flags_[k] = std::max(flags_[k], message[1 + k]);
}

void Butterfly::take(int step, Direction direction, const Link& link,
                     std::span<const double> message) {
    const RecordReader incoming(message.subspan(head_length));
    if (incoming.at_end()) return;
    if (direction == to_owners && join_ != nullptr) note_asked(step, link.rank, incoming);
    Records& records = direction == to_owners ? held_ : answers_;
    records = merged(records.read(), incoming);
}

/// Notes the rank that is to receive the answers to some records.
void Butterfly::note_asked(int step, int rank, RecordReader incoming) {
    const std::size_t begin = keys_asked_.size();
    while (!incoming.at_end()) keys_asked_.push_back(incoming.next().key);
    asked_.push_back({step, rank, begin, keys_asked_.size()});
}

/// Merges two lists of records that are both ordered by key.
Records Butterfly::merged(RecordReader mine, RecordReader others) const {
    Records result;
    // This is an upper bound; memory is left unused if records are joined.
    result.reserve_bytes(mine.words().size_bytes() + others.words().size_bytes());
    // Invariant: the result contains all records before the next ones of both lists.
    while (!mine.at_end() && !others.at_end()) {
        if (join_ != nullptr && mine.key() == others.key()) {
            const Record a = mine.next();
            result.append_joined(a, others.next(), join_);
        } else {
            result.append(mine.key() <= others.key() ? mine.next() : others.next());
        }
    }
    for (RecordReader* rest : {&mine, &others})
        while (!rest->at_end()) result.append(rest->next());
    return result;
}

}  // namespace rrcb
