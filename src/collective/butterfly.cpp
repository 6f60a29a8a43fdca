#include "collective/butterfly.hpp"

#include <algorithm>

namespace rrcb {

Butterfly::Butterfly(int rank, int num_ranks, Join join, Way way)
    : rank_(rank), num_ranks_(num_ranks), join_(join), way_(way), halves_(halves_of(0, num_ranks)) {
    const auto goes_on = [&] { return way == Way::spread || halves_.begin == 0; };
    while (halves_.end - halves_.begin > 1 && goes_on()) halves_at(++num_steps_);
}

const Butterfly::Halves& Butterfly::halves_at(int step) {
    if (step < step_of_halves_) {
        step_of_halves_ = 0;
        halves_ = halves_of(0, num_ranks_);
    }
    // This rank is always in `halves_`. Without branches, because the half is unpredictable.
    for (; step_of_halves_ < step; ++step_of_halves_) {
        const bool is_below = rank_ < halves_.middle;
        halves_ = halves_of(is_below ? halves_.begin : halves_.middle,
                            is_below ? halves_.middle : halves_.end);
    }
    return halves_;
}

Butterfly::Links Butterfly::links(int step, Direction direction) {
    const Halves& halves = halves_at(step);
    const int mirror = halves.begin + (halves.end - 1 - rank_);
    const bool to = direction == to_owners;
    if (is_central()) {
        const bool sends = to == (rank_ >= halves.middle);
        return {{Link{mirror, sends, !sends}}, mirror == rank_ ? 0U : 1U};
    }
    // With an odd number of ranks the last of the lower half has no partner: it sends its records
    // to the first of the other half, and gets none.
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
    const Halves& halves = halves_at(step);
    const bool is_below = rank_ < halves.middle;
    const int begin = is_below ? halves.begin : halves.middle;
    const int end = is_below ? halves.middle : halves.end;
    // Mostly true if points are near the ranks of their parts.
    if (held_.are_owned_between(begin, end)) return;
    const auto stays_here = [&](const Record& record) {
        return begin <= record.owner && record.owner < end;
    };
    held_.for_each([&](const Record& record) {
        if (!stays_here(record)) append_to_message(record);
    });
    held_.keep(stays_here);
}

/// Adds the answers to the records that a rank sent in a step to the message.
void Butterfly::reply(int step, int rank) {
    const auto asked = std::ranges::find_if(
        asked_, [&](const Asked& one) { return one.step == step && one.rank == rank; });
    if (asked == asked_.end()) return;
    std::size_t next = asked->begin;
    for (RecordReader reader = answers_.read(); !reader.at_end() && next < asked->end;) {
        const Record answer = reader.next();
        while (next < asked->end && keys_asked_[next] < answer.key) ++next;
        if (next < asked->end && keys_asked_[next] == answer.key) append_to_message(answer);
    }
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

/// Notes the rank that gets the answers to records.
void Butterfly::note_asked(int step, int rank, RecordReader incoming) {
    const std::size_t begin = keys_asked_.size();
    while (!incoming.at_end()) keys_asked_.push_back(incoming.next().key);
    asked_.push_back({step, rank, begin, keys_asked_.size()});
}

/// Merges records, both in the order of their keys.
Records Butterfly::merged(RecordReader mine, RecordReader others) const {
    Records result;
    // Records that add up leave the rest of this memory untouched.
    result.reserve_bytes(mine.words().size_bytes() + others.words().size_bytes());
    Record a{};
    Record b{};
    bool has_a = !mine.at_end();
    bool has_b = !others.at_end();
    if (has_a) a = mine.next();
    if (has_b) b = others.next();
    // The result has all records before `a` and before `b`.
    while (has_a || has_b) {
        const bool takes_a = has_a && (!has_b || a.key <= b.key);
        const bool takes_b = !takes_a || (has_b && b.key == a.key && join_ != nullptr);
        if (takes_a && takes_b) {
            result.append_joined(a, b, join_);
        } else {
            result.append(takes_a ? a : b);
        }
        if (takes_a && (has_a = !mine.at_end())) a = mine.next();
        if (takes_b && (has_b = !others.at_end())) b = others.next();
    }
    return result;
}

}  // namespace rrcb
