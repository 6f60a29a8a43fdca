#include "collective/butterfly.hpp"

#include <algorithm>
#include <utility>

namespace rrcb {

Butterfly::Butterfly(int rank, int num_ranks, Join join)
    : rank_(rank), num_ranks_(num_ranks), join_(join) {
    message_.reserve(head_length);
}

Butterfly::Halves Butterfly::halves_at(int step) const {
    Halves halves{0, 0, num_ranks_};
    // Before each turn this rank is one of those from begin to end.
    for (int k = 0;; ++k) {
        const int length = halves.end - halves.begin;
        halves.middle = halves.begin + length / 2 + length % 2;
        if (k == step) return halves;
        (rank_ < halves.middle ? halves.end : halves.begin) = halves.middle;
    }
}

int Butterfly::num_steps() const {
    int step = 0;
    for (Halves halves = halves_at(0); halves.end - halves.begin > 1; halves = halves_at(step))
        ++step;
    return step;
}

Butterfly::Links Butterfly::links(int step, Direction direction) const {
    const Halves halves = halves_at(step);
    const int mirror = halves.begin + (halves.end - 1 - rank_);
    const bool to = direction == to_owners;
    // Of an odd number of ranks the last of the lower half has none across from it: it hands its
    // records to the first of the other half, and gets none.
    if (mirror == rank_) return {{Link{halves.middle, to, !to}}, 1};
    const bool is_odd = (halves.end - halves.begin) % 2 != 0;
    return {{Link{mirror, true, true}, Link{rank_ - 1, !to, to}},
            is_odd && rank_ == halves.middle ? 2U : 1U};
}

void Butterfly::clear() {
    held_.clear();
    answers_.clear();
    asked_.clear();
}

void Butterfly::pack_nothing() {
    message_.resize(head_length);
    message_[0] = head_length;
    std::ranges::copy(flags_, message_.begin() + 1);
}

void Butterfly::pack(int step, Direction direction, const Link& link) {
    pack_nothing();
    if (direction == to_owners) {
        hand_over(step);
    } else {
        reply(step, link.rank);
    }
    message_[0] = static_cast<double>(message_.size());
}

/// Moves the records whose owner is in the other half into the message.
void Butterfly::hand_over(int step) {
    if (held_.empty()) return;
    const Halves halves = halves_at(step);
    const bool is_below = rank_ < halves.middle;
    const auto stays_here = [&](const Record& record) {
        return (record.owner < halves.middle) == is_below;
    };
    bool all_stay = true;
    held_.for_each([&](const Record& record) { all_stay = all_stay && stays_here(record); });
    // Mostly so where points lie near the ranks of their parts; then nothing is copied.
    if (all_stay) return;
    Records stay;
    held_.for_each([&](const Record& record) {
        if (stays_here(record)) return stay.append(record);
        append_record(message_, record);
    });
    held_ = std::move(stay);
}

/// Puts the answers to what came from a rank in a step into the message.
void Butterfly::reply(int step, int rank) {
    const auto asked = std::ranges::find_if(
        asked_, [&](const Asked& one) { return one.step == step && one.rank == rank; });
    if (asked == asked_.end()) return;
    auto key = asked->keys.begin();
    answers_.for_each([&](const Record& answer) {
        while (key != asked->keys.end() && *key < answer.key) ++key;
        if (key != asked->keys.end() && *key == answer.key) append_record(message_, answer);
    });
}

void Butterfly::hear(std::span<const double> message) {
    for (std::size_t k = 0; k < flags_.size(); ++k) flags_[k] = std::max(flags_[k], message[1 + k]);
}

void Butterfly::take(int step, Direction direction, const Link& link,
                     std::span<const double> message) {
    const RecordReader incoming(message.subspan(head_length));
    if (incoming.at_end()) return;
    if (direction == back) {
        answers_ = merged(answers_, incoming);
        return;
    }
    Asked asked{step, link.rank, {}};
    for (RecordReader reader = incoming; !reader.at_end();) asked.keys.push_back(reader.next().key);
    asked_.push_back(std::move(asked));
    held_ = merged(held_, incoming);
}

/// Both in the order of their keys.
Records Butterfly::merged(const Records& records, RecordReader others) const {
    Records result;
    std::vector<double> joined;
    RecordReader mine = records.read();
    Record a{};
    Record b{};
    bool has_a = !mine.at_end();
    bool has_b = !others.at_end();
    if (has_a) a = mine.next();
    if (has_b) b = others.next();
    // All records before `a` here and before `b` there are in the result.
    while (has_a || has_b) {
        const bool takes_a = has_a && (!has_b || a.key <= b.key);
        const bool takes_b = !takes_a || (has_b && b.key == a.key && join_ != nullptr);
        if (takes_a && takes_b) {
            joined.clear();
            join_(a.payload, b.payload, joined);
            result.append({a.key, a.owner, joined});
        } else {
            result.append(takes_a ? a : b);
        }
        if (takes_a && (has_a = !mine.at_end())) a = mine.next();
        if (takes_b && (has_b = !others.at_end())) b = others.next();
    }
    return result;
}

}  // namespace rrcb
