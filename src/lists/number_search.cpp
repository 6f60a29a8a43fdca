#include "lists/number_search.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>

namespace rrcb {

namespace {

std::size_t length_of(PartRange range) {
    return static_cast<std::size_t>(range.end - range.first);
}

}  // namespace

std::int32_t NumberRule::home_of(Part number) const {
    if (!by_rank) return number;
    return listed.empty() ? ranks_of_part(number, num_parts, num_ranks).first_rank
                          : listed[number].first_rank;
}

PartRange NumberRule::numbers_of(std::int32_t origin) const {
    if (!by_rank) return {origin, origin + 1};
    return listed.empty() ? parts_from(origin, num_parts, num_ranks) : parts_from(origin, listed);
}

int NumberRule::group_of(std::int32_t origin) const {
    const PartRange numbers = numbers_of(origin);
    const int group = group_of_part(numbers.first);
    for (Part number = numbers.first + 1; number < numbers.end; ++number)
        if (group_of_part(number) != group) return -1;
    return group;
}

int NumberRule::searcher_of(Part part) const {
    return is_spread ? ranks_of_part(part, num_parts, num_ranks).first_rank : 0;
}

PartRange NumberRule::parts_of(int rank) const {
    if (is_spread) return parts_from(rank, num_parts, num_ranks);
    return {0, rank == 0 ? num_parts : 0};
}

NumberSearch::NumberSearch(const NumberRule& rule, int rank)
    : rule_(rule),
      parts_(rule.parts_of(rank)),
      own_numbers_(rule.numbers_at(rank)),
      wishes_(length_of(parts_)),
      was_refused_(length_of(parts_)),
      numbers_(length_of(parts_)),
      is_used_(length_of(own_numbers_)) {}

void NumberSearch::hand_in(std::span<const Overlap> overlaps, Butterfly& told) const {
    std::vector<double> payload;
    for (std::size_t k = 0; k < overlaps.size(); ++k) {
        const auto& [origin, part, count] = overlaps[k];
        payload.insert(payload.end(), {static_cast<double>(origin), static_cast<double>(count)});
        if (k + 1 < overlaps.size() && overlaps[k + 1].part == part) continue;
        told.add(static_cast<Key>(part), rule_.searcher_of(part), payload);
        payload.clear();
    }
}

void NumberSearch::start(const Records& told) {
    told.for_each([&](const Record& record) {
        const auto part = static_cast<Part>(record.key);
        std::vector<Wish>& wishes = wishes_[index_of(part)];
        wishes.reserve(record.payload.size() / 2 + 1);
        for (std::size_t k = 0; k < record.payload.size(); k += 2) {
            const auto origin = static_cast<std::int32_t>(record.payload[k]);
            const double count = record.payload[k + 1];
            num_points_ += static_cast<GlobalCount>(count);
            if (origin == no_origin) continue;
            wishes.push_back({count, origin == rule_.home_of(part), origin});
        }
    });
    for (std::size_t i = 0; i < wishes_.size(); ++i) {
        if (std::ranges::none_of(wishes_[i], &Wish::keeps))
            wishes_[i].push_back({0, true, rule_.home_of(part_at(i))});
        std::ranges::sort(wishes_[i], [](const Wish& a, const Wish& b) {
            return std::tie(b.count, b.keeps, a.origin) < std::tie(a.count, a.keeps, b.origin);
        });
    }
    reset();
}

NumberSearch::Offer NumberSearch::offer_of(const Wish& wish, Part part) {
    return {wish.count, wish.keeps ? 1.0 : 0.0, -static_cast<double>(part)};
}

bool NumberSearch::offer(Butterfly& offers) const {
    bool any_moves = false;
    std::map<std::int32_t, std::vector<double>> records;
    for (std::size_t i = 0; i < wishes_.size(); ++i) {
        bool is_first = true;
        for (const Wish& wish : wishes_[i]) {
            if (wish.is_lost) continue;
            std::vector<double>& record = records[wish.origin];
            if (is_first) {
                const Offer offer = offer_of(wish, part_at(i));
                record.insert(record.end(), offer.begin(), offer.end());
                any_moves = any_moves || !wish.keeps;
                is_first = false;
            }
            if (!was_refused_[i]) break;
        }
    }
    for (const auto& [origin, record] : records)
        offers.add(static_cast<Key>(origin), rule_.searcher_of_origin(origin), record);
    return any_moves;
}

bool NumberSearch::choose(Butterfly& offers) {
    bool refuses_any = false;
    std::fill(is_used_.begin(), is_used_.end(), false);
    offers.owned().for_each([&](const Record& record) {
        const PartRange numbers = rule_.numbers_of(static_cast<std::int32_t>(record.key));
        std::vector<Offer> accepted;
        for (std::size_t k = 0; k < record.payload.size(); k += 3)
            accepted.push_back({record.payload[k], record.payload[k + 1], record.payload[k + 2]});
        refuses_any = refuses_any || accepted.size() > length_of(numbers);
        Offer least{-1, 0, 0};
        if (accepted.size() >= length_of(numbers) && length_of(numbers) > 0) {
            const auto last = accepted.begin() + (numbers.end - numbers.first - 1);
            std::ranges::nth_element(accepted, last, std::greater<>());
            least = *last;
        }
        accepted.resize(std::min(accepted.size(), length_of(numbers)));
        std::vector<double> answer(least.begin(), least.end());
        give_numbers(accepted, numbers, answer);
        offers.answer(record.key, answer);
    });
    return refuses_any;
}

/// Parts keep their number if it is among these. The others get the rest, both ascending.
void NumberSearch::give_numbers(std::vector<Offer>& accepted, PartRange numbers,
                                std::vector<double>& answer) {
    std::ranges::sort(accepted, {},
                      [](const Offer& offer) { return std::pair(-offer[1], -offer[2]); });
    Part next = numbers.first;
    const auto is_used = [&](Part number) { return is_used_[number - own_numbers_.first]; };
    for (const auto& [count, keeps, minus_part] : accepted) {
        while (keeps == 0 && is_used(next)) ++next;
        const Part number = keeps == 0 ? next : static_cast<Part>(-minus_part);
        is_used(number) = true;
        answer.insert(answer.end(), {-minus_part, static_cast<double>(number)});
    }
}

void NumberSearch::follow(const Butterfly& offers) {
    std::ranges::fill(numbers_, no_part);
    std::map<std::int32_t, Offer> least;
    offers.answers().for_each([&](const Record& answer) {
        const auto payload = answer.payload;
        least[static_cast<std::int32_t>(answer.key)] = {payload[0], payload[1], payload[2]};
        for (std::size_t k = 3; k < payload.size(); k += 2)
            if (const auto part = static_cast<Part>(payload[k]); is_here(part))
                numbers_[index_of(part)] = static_cast<Part>(payload[k + 1]);
    });
    for (std::size_t i = 0; i < wishes_.size(); ++i) {
        const auto current = std::ranges::find(wishes_[i], false, &Wish::is_lost);
        // Only larger offers take the place of accepted ones, so a refusal is final.
        for (auto wish = current; wish != wishes_[i].end(); ++wish)
            if (const auto found = least.find(wish->origin); found != least.end())
                wish->is_lost = wish->is_lost || offer_of(*wish, part_at(i)) < found->second;
        was_refused_[i] = current != wishes_[i].end() && current->is_lost;
    }
}

NumberSearch::Counts NumberSearch::left() const {
    return {std::ranges::count(numbers_, no_part),
            std::count(is_used_.begin(), is_used_.end(), false)};
}

void NumberSearch::meet(const Counts& before, Butterfly& left) const {
    std::map<std::int64_t, std::vector<double>> numbers;  // unused one, if any, by count
    const auto [num_parts, num_numbers] = this->left();
    for (std::int64_t k = 0; k < num_parts; ++k) numbers[before[0] + k] = {};
    std::int64_t next = before[1];
    for (std::size_t i = 0; i < is_used_.size(); ++i)
        if (!is_used_[i]) numbers[next++] = {own_numbers_.first + static_cast<double>(i)};
    for (const auto& [count, number] : numbers)
        left.add(static_cast<Key>(count), rule_.searcher_of(static_cast<Part>(count)), number);
}

void NumberSearch::take(const Counts& before, const Butterfly& left) {
    std::map<Key, Part> met;
    left.answers().for_each([&](const Record& answer) {
        // A failure elsewhere may have lost a number.
        if (!answer.payload.empty()) met[answer.key] = static_cast<Part>(answer.payload[0]);
    });
    auto next = static_cast<Key>(before[0]);
    for (Part& number : numbers_)
        if (const auto found = number == no_part ? met.find(next++) : met.end(); found != met.end())
            number = found->second;
}

std::array<GlobalCount, 3> NumberSearch::count_points() const {
    std::array<GlobalCount, 3> sums{num_points_, 0, 0};
    for (std::size_t i = 0; i < wishes_.size(); ++i) {
        const Part number = numbers_[i];
        for (const Wish& wish : wishes_[i]) {
            const auto count = static_cast<GlobalCount>(wish.count);
            if (wish.keeps) sums[1] += count;
            if (number != no_part && wish.origin == rule_.home_of(number)) sums[2] += count;
        }
    }
    return sums;
}

void NumberSearch::reset() {
    std::iota(numbers_.begin(), numbers_.end(), parts_.first);
}

void NumberSearch::add_up(std::span<const double> a, std::span<const double> b,
                          std::vector<double>& joined) {
    // Both ascend by origin.
    while (!a.empty() || !b.empty()) {
        const bool takes_a = !a.empty() && (b.empty() || a[0] <= b[0]);
        const bool takes_b = !b.empty() && (a.empty() || b[0] <= a[0]);
        joined.push_back(takes_a ? a[0] : b[0]);
        joined.push_back((takes_a ? a[1] : 0) + (takes_b ? b[1] : 0));
        if (takes_a) a = a.subspan(2);
        if (takes_b) b = b.subspan(2);
    }
}

void NumberSearch::append(std::span<const double> a, std::span<const double> b,
                          std::vector<double>& joined) {
    joined.insert(joined.end(), a.begin(), a.end());
    joined.insert(joined.end(), b.begin(), b.end());
}

}  // namespace rrcb
