#include "cuts/number_search.hpp"

#include <algorithm>
#include <tuple>

namespace rrcb {

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

NumberRule NumberRule::of_groups() const {
    return {(num_parts - 1) / shape.group_size + 1, num_ranks, false};
}

Part NumberRule::with_group(Part part, std::span<const Part> numbers_of_groups) const {
    const Part end = shape.end_of(part, num_parts);
    const int size = shape.group_size;
    return shape.part_at(numbers_of_groups[end / size] * size + end % size, num_parts);
}

namespace {

std::size_t num_origins(const NumberRule& rule) {
    return static_cast<std::size_t>(rule.by_rank ? rule.num_ranks : rule.num_parts);
}

/// Returns an origin for each part, such that the origin has a number for it. Parts that are left
/// over get no_origin.
std::vector<std::int32_t> greedy_origins(const NumberRule& rule,
                                         std::span<const Overlap> overlaps) {
    std::vector<int> num_free(num_origins(rule));
    std::vector<Overlap> offers(overlaps.begin(), overlaps.end());
    std::erase_if(offers, [](const Overlap& offer) { return offer.origin == no_origin; });
    // After all overlaps, a part may still get its own number.
    for (Part part = 0; part < rule.num_parts; ++part) {
        ++num_free[rule.home_of(part)];
        offers.push_back({rule.home_of(part), part, 0});
    }
    std::ranges::sort(offers, {}, [&](const Overlap& offer) {
        return std::tuple(-offer.count, rule.home_of(offer.part) != offer.origin, offer.part,
                          offer.origin);
    });
    std::vector<std::int32_t> origins(static_cast<std::size_t>(rule.num_parts), no_origin);
    for (const auto& [origin, part, count] : offers) {
        if (origins[part] != no_origin || num_free[origin] == 0) continue;
        origins[part] = origin;
        --num_free[origin];
    }
    return origins;
}

}  // namespace

std::vector<Part> greedy_numbers(const NumberRule& rule, std::span<const Overlap> overlaps) {
    const std::vector<std::int32_t> origins = greedy_origins(rule, overlaps);
    std::vector<Part> numbers(origins.size(), no_part);
    std::vector<bool> is_used(origins.size());
    const auto give = [&](Part part, Part number) {
        numbers[part] = number;
        is_used[number] = true;
    };
    for (Part part = 0; part < rule.num_parts; ++part)
        if (origins[part] == rule.home_of(part)) give(part, part);
    const auto give_next = [&](Part part, Part& next) {
        while (is_used[next]) ++next;
        give(part, next);
    };
    std::vector<Part> next(num_origins(rule));  // next number of each origin
    for (Part number = rule.num_parts; number-- > 0;) next[rule.home_of(number)] = number;
    for (Part part = 0; part < rule.num_parts; ++part)
        if (numbers[part] == no_part && origins[part] != no_origin)
            give_next(part, next[origins[part]]);
    // For the parts that are left over: numbers ascend with the ends of the tree within a group.
    const int size = rule.shape.group_size > 1 ? rule.shape.group_size : rule.num_parts;
    std::vector<Part> next_end;
    for (Part end = 0; end < rule.num_parts; end += size) next_end.push_back(end);
    for (Part part = 0; part < rule.num_parts; ++part) {
        if (numbers[part] != no_part) continue;
        Part& end = next_end[rule.shape.end_of(part, rule.num_parts) / size];
        while (is_used[rule.shape.part_at(end, rule.num_parts)]) ++end;
        give(part, rule.shape.part_at(end, rule.num_parts));
    }
    return numbers;
}

}  // namespace rrcb
