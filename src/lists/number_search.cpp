#include "lists/number_search.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

namespace rrcb {

namespace {

constexpr std::int32_t none = -1;

/// The order of offers for one part: count, whether it keeps its number, origin. Doubles, which
/// hold counts below 2^53 exactly.
auto rank_among_offers(std::span<const double> offer) {
    return std::tuple(offer[0], offer[1], -offer[2]);
}

/// What asks for the largest offer and makes none.
constexpr std::array<double, 3> question{0, 0, none};

std::array<double, 3> offer_of(const Overlap& overlap, const NumberRule& rule) {
    return {static_cast<double>(overlap.count),
            overlap.origin == rule.home_of(overlap.part) ? 1.0 : 0.0,
            static_cast<double>(overlap.origin)};
}

}  // namespace

NumberSearch::NumberSearch(int num_parts, int num_ranks, int rank)
    : rule_{num_parts, num_ranks},
      rank_(rank),
      own_(parts_on(rank, num_parts, num_ranks)),
      origins_of_(static_cast<std::size_t>(own_.end - own_.first), none) {}

void NumberSearch::start(Origins origins, std::span<const Overlap> overlaps) {
    rule_.origins = origins;
    is_lost_.assign(overlaps.size(), false);
    overlaps_.assign(overlaps.begin(), overlaps.end());
    std::ranges::sort(overlaps_, [&](const Overlap& a, const Overlap& b) {
        const bool a_moves = rule_.home_of(a.part) != a.origin;
        const bool b_moves = rule_.home_of(b.part) != b.origin;
        return std::tie(a.origin, b.count, a_moves, a.part) <
               std::tie(b.origin, a.count, b_moves, b.part);
    });
    const int num_numbers = origins == Origins::ranks ? own_.end - own_.first : 1;
    for (std::size_t k = 0; k < overlaps_.size(); ++k) {
        if (k == 0 || overlaps_[k].origin != overlaps_[k - 1].origin)
            origins_.push_back({k, k, num_numbers, false});
        ++origins_.back().end;
    }
}

/// Makes offers until no number is free that has another to make; returns whether it made any.
bool NumberSearch::make_offers() {
    bool made_any = false;
    const auto origin_of = [&](std::size_t overlap) -> Origin& {
        return *std::ranges::upper_bound(origins_, overlap, {}, &Origin::end);
    };
    std::vector<Origin*> waiting;
    for (Origin& origin : origins_) waiting.push_back(&origin);
    while (!waiting.empty()) {
        Origin& origin = *waiting.back();
        if (origin.num_free == 0 || origin.next == origin.end) {
            waiting.pop_back();
            continue;
        }
        const std::size_t mine = origin.next++;
        if (is_lost_[mine]) continue;
        const auto [standing, is_first] = offers_.emplace(overlaps_[mine].part, mine);
        const std::size_t other = standing->second;
        if (!is_first && rank_among_offers(offer_of(overlaps_[mine], rule_)) <=
                             rank_among_offers(offer_of(overlaps_[other], rule_)))
            continue;
        made_any = true;
        --origin.num_free;
        if (is_first) continue;
        // Two origins of this rank ask for one part.
        standing->second = mine;
        ++origin_of(other).num_free;
        waiting.push_back(&origin_of(other));
    }
    return made_any;
}

NumberSearch::News NumberSearch::offer(Butterfly& offers) {
    const bool is_new = make_offers();
    bool moves = false;
    std::map<Part, std::array<double, 3>> records;
    for (const auto& [part, overlap] : offers_) {
        const auto& offer = records[part] = offer_of(overlaps_[overlap], rule_);
        moves = moves || offer[1] == 0;
    }
    for (const Origin& origin : origins_)
        for (std::size_t k = origin.next; origin.was_refused && k < origin.end; ++k)
            if (!is_lost_[k]) records.try_emplace(overlaps_[k].part, question);
    for (const auto& [part, record] : records)
        offers.add(static_cast<Key>(part), rule_.rank_of(part), record);
    if (!is_new) return News::none;
    return moves ? News::elsewhere : News::at_home;
}

void NumberSearch::choose(Butterfly& offers) {
    offers.owned().for_each([&](const Record& offer) {
        origins_of_[index_of(static_cast<Part>(offer.key))] =
            static_cast<std::int32_t>(offer.payload[2]);
    });
    answer_all(offers);
}

void NumberSearch::follow(const Butterfly& offers) {
    std::map<Part, std::span<const double>> largest;
    offers.answers().for_each([&](const Record& answer) {
        largest.emplace(static_cast<Part>(answer.key), answer.payload);
    });
    // An offer that another is larger than is lost for good, as only larger ones take its place.
    const auto is_lost = [&](std::size_t overlap) {
        const auto other = largest.find(overlaps_[overlap].part);
        return other != largest.end() && rank_among_offers(offer_of(overlaps_[overlap], rule_)) <
                                             rank_among_offers(other->second);
    };
    for (Origin& origin : origins_) {
        for (std::size_t k = origin.next; origin.was_refused && k < origin.end; ++k)
            is_lost_[k] = is_lost_[k] || is_lost(k);
        origin.was_refused = false;
    }
    for (auto offer = offers_.begin(); offer != offers_.end();) {
        const std::size_t mine = offer->second;
        if (!is_lost(mine)) {
            ++offer;
            continue;
        }
        Origin& origin = *std::ranges::upper_bound(origins_, mine, {}, &Origin::end);
        ++origin.num_free;
        origin.was_refused = true;
        offer = offers_.erase(offer);
    }
}

NumberSearch::Counts NumberSearch::settle() {
    for (const auto& [part, overlap] : offers_)
        placed_.emplace_back(part, overlaps_[overlap].origin);
    list_numbers_left();
    // Both ascend; what is left of the numbers before `number` is in `unused`.
    std::vector<std::int32_t> unused;
    auto number = numbers_left_.begin();
    for (Part part = own_.first; part < own_.end; ++part) {
        if (origins_of_[index_of(part)] != none) continue;
        const std::int32_t home = rule_.home_of(part);
        while (number != numbers_left_.end() && *number < home) unused.push_back(*number++);
        if (number == numbers_left_.end() || *number != home) {
            left_.push_back(part);
            continue;
        }
        origins_of_[index_of(part)] = home;
        placed_.emplace_back(part, home);
        ++number;
    }
    unused.insert(unused.end(), number, numbers_left_.end());
    numbers_left_ = std::move(unused);
    std::ranges::sort(placed_);
    return {std::ssize(left_), std::ssize(numbers_left_)};
}

void NumberSearch::list_numbers_left() {
    std::vector<std::int32_t> used;
    for (const auto& [part, origin] : placed_) used.push_back(origin);
    std::ranges::sort(used);
    std::vector<std::int32_t> all;
    for (Part part = own_.first; part < own_.end; ++part) all.push_back(rule_.home_of(part));
    std::ranges::set_difference(all, used, std::back_inserter(numbers_left_));
}

bool NumberSearch::meet(const Counts& before, Butterfly& left) const {
    std::map<Key, std::array<double, 2>> pairs;  // of a part and an origin
    const auto pair_at = [&](std::int64_t count) -> std::array<double, 2>& {
        return pairs.try_emplace(static_cast<Key>(count), std::array<double, 2>{none, none})
            .first->second;
    };
    for (std::int64_t k = 0; k < std::ssize(left_); ++k)
        pair_at(before.parts + k)[0] = left_[static_cast<std::size_t>(k)];
    for (std::int64_t k = 0; k < std::ssize(numbers_left_); ++k)
        pair_at(before.numbers + k)[1] = numbers_left_[static_cast<std::size_t>(k)];
    for (const auto& [count, pair] : pairs)
        left.add(count, rule_.rank_of(static_cast<Part>(count)), pair);
    return !pairs.empty();
}

void NumberSearch::take(const Counts& before, const Butterfly& left) {
    left.answers().for_each([&](const Record& pair) {
        const auto count = static_cast<std::int64_t>(pair.key);
        const bool is_mine =
            count >= before.numbers && count < before.numbers + std::ssize(numbers_left_);
        // A failure elsewhere may have lost the part.
        if (is_mine && pair.payload[0] >= 0)
            placed_.emplace_back(static_cast<Part>(pair.payload[0]),
                                 static_cast<std::int32_t>(pair.payload[1]));
    });
    std::ranges::sort(placed_);
}

NumberSearch::Kept NumberSearch::kept() const {
    Kept kept;
    for (const Overlap& overlap : overlaps_) {
        if (overlap.origin == rule_.home_of(overlap.part)) kept.before += overlap.count;
        if (std::ranges::binary_search(placed_, Numbered(overlap.part, overlap.origin)))
            kept.after += overlap.count;
    }
    return kept;
}

/// Of the parts that go to origins of this rank, those whose numbers change; ascending by part.
std::vector<Numbered> NumberSearch::new_numbers() const {
    std::vector<Numbered> changed;
    for (const auto& [part, origin] : placed_)
        if (origin != rule_.home_of(part)) changed.emplace_back(part, origin);
    if (rule_.origins == Origins::parts) return changed;
    // Parts that come to this rank get the numbers of those that go, both ascending.
    auto incoming = changed.begin();
    for (Part part = own_.first; part < own_.end && incoming != changed.end(); ++part)
        if (origins_of_[index_of(part)] != rank_) (incoming++)->second = part;
    return changed;
}

void NumberSearch::tell(std::span<const Part> parts, Butterfly& numbers) const {
    std::map<Part, Part> told;
    for (const Part part : parts) told.emplace(part, none);
    for (const auto& [part, number] : new_numbers()) told[part] = number;
    for (const auto& [part, number] : told)
        numbers.add(static_cast<Key>(part), rule_.rank_of(part),
                    std::array{static_cast<double>(number)});
}

void NumberSearch::conclude(Butterfly& numbers) {
    numbers_.resize(origins_of_.size());
    std::iota(numbers_.begin(), numbers_.end(), own_.first);
    numbers.owned().for_each([&](const Record& told) {
        Part& number = numbers_[index_of(static_cast<Part>(told.key))];
        if (told.payload[0] >= 0) number = static_cast<Part>(told.payload[0]);
        numbers.answer(told.key, std::array{static_cast<double>(number)});
    });
}

std::vector<Numbered> NumberSearch::result(const Butterfly& numbers) const {
    std::vector<Numbered> result;
    for (Part part = own_.first; part < own_.end; ++part)
        result.emplace_back(part, numbers_[index_of(part)]);
    numbers.answers().for_each([&](const Record& answer) {
        result.emplace_back(static_cast<Part>(answer.key), static_cast<Part>(answer.payload[0]));
    });
    std::ranges::sort(result);
    // Not std::ranges::unique, whose answer clang 14 cannot read with GCC's library.
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

void NumberSearch::keep_larger(std::span<const double> a, std::span<const double> b,
                               std::vector<double>& joined) {
    const auto larger = rank_among_offers(a) < rank_among_offers(b) ? b : a;
    joined.insert(joined.end(), larger.begin(), larger.end());
}

void NumberSearch::unite(std::span<const double> a, std::span<const double> b,
                         std::vector<double>& joined) {
    for (std::size_t k = 0; k < a.size(); ++k) joined.push_back(std::max(a[k], b[k]));
}

void answer_all(Butterfly& butterfly) {
    butterfly.owned().for_each(
        [&](const Record& record) { butterfly.answer(record.key, record.payload); });
}

}  // namespace rrcb
