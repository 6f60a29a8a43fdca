// The search for numbers of parts, compared with the definition of the greedy method.
#include "cuts/number_search.hpp"

#include "../support/clouds.hpp"
#include "../support/common.hpp"

namespace rrcb {
namespace {

using Overlaps = std::vector<Overlap>;
using Numbers = std::vector<Part>;

/// Origin of each part by the greedy method, which looks for the largest overlap each time;
/// no_origin of parts left over.
std::vector<std::int32_t> origins_by_definition(const NumberRule& rule, Overlaps overlaps) {
    std::map<std::int32_t, int> num_free;
    for (Part part = 0; part < rule.num_parts; ++part) {
        ++num_free[rule.home_of(part)];
        overlaps.push_back({rule.home_of(part), part, 0});
    }
    std::vector<std::int32_t> origins(static_cast<std::size_t>(rule.num_parts), no_origin);
    for (;;) {
        std::erase_if(overlaps, [&](const Overlap& o) {
            return origins[static_cast<std::size_t>(o.part)] != no_origin ||
                   num_free[o.origin] == 0;
        });
        if (overlaps.empty()) return origins;
        const auto [origin, part, count] =
            *std::ranges::min_element(overlaps, {}, [&](const Overlap& o) {
                return std::tuple(-o.count, rule.home_of(o.part) != o.origin, o.part, o.origin);
            });
        origins[static_cast<std::size_t>(part)] = origin;
        --num_free[origin];
    }
}

void expect_greedy(const NumberRule& rule, const Overlaps& overlaps) {
    const Numbers numbers = greedy_numbers(rule, overlaps);
    Numbers sorted = numbers;
    std::ranges::sort(sorted);
    Numbers all(static_cast<std::size_t>(rule.num_parts));
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(sorted, all);
    const std::vector<std::int32_t> expected = origins_by_definition(rule, overlaps);
    std::map<std::int32_t, Part> last;
    for (std::size_t part = 0; part < numbers.size(); ++part) {
        if (expected[part] != no_origin) {
            ASSERT_EQ(rule.home_of(numbers[part]), expected[part]) << "part " << part;
        }
        // Parts of one origin keep their number; the others have ascending ones.
        if (rule.home_of(static_cast<Part>(part)) == expected[part]) {
            EXPECT_EQ(numbers[part], static_cast<Part>(part));
            continue;
        }
        const auto [before, is_first] = last.try_emplace(expected[part], -1);
        EXPECT_LT(std::exchange(before->second, numbers[part]), numbers[part]);
    }
}

/// Overlaps of few counts, so that many are equal, of `per_origin` parts each; some origins have
/// none.
Overlaps random_overlaps(const NumberRule& rule, int per_origin, unsigned seed) {
    std::mt19937_64 engine(seed);
    const auto draw = [&](int end) { return static_cast<int>(test::uniform(engine, 0, end)); };
    Overlaps overlaps;
    for (int origin = 0; origin < (rule.by_rank ? rule.num_ranks : rule.num_parts); ++origin) {
        const PartRange numbers = rule.numbers_of(origin);
        if (draw(7) == 0 || numbers.first == numbers.end) continue;
        std::vector<Part> parts;
        for (int k = 0; k < per_origin; ++k)
            parts.push_back(draw(2) == 0 ? draw(rule.num_parts)
                                         : (origin + draw(5)) % rule.num_parts);
        std::ranges::sort(parts);
        parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
        for (const Part part : parts) overlaps.push_back({origin, part, 1 + draw(4)});
    }
    return overlaps;
}

TEST(NumberSearch, finds_the_numbers_of_the_greedy_method) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        NumberRule rule{1, 1 + static_cast<int>(seed * 13 % 40)};
        rule.num_parts = rule.num_ranks + static_cast<int>(seed % 3 * seed % 50);
        rule.by_rank = seed % 5 < 3;
        SCOPED_TRACE(seed);
        Overlaps overlaps = random_overlaps(rule, 1 + static_cast<int>(seed % 9), seed);
        expect_greedy(rule, overlaps);
        // Points without an origin change nothing.
        const Numbers numbers = greedy_numbers(rule, overlaps);
        overlaps.push_back({no_origin, 0, 1000});
        EXPECT_EQ(greedy_numbers(rule, overlaps), numbers);
    }
}

TEST(NumberSearch, takes_any_numbers_of_parts_on_the_ranks) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        std::mt19937_64 engine(seed);
        std::vector<RankRange> listed;
        for (int rank = 0; rank < 6; ++rank)
            listed.insert(listed.end(), engine() % 5, RankRange{rank, 1});
        listed.push_back({6, 1});
        const NumberRule rule{static_cast<int>(listed.size()), 9, true, listed};
        SCOPED_TRACE(seed);
        expect_greedy(rule, random_overlaps(rule, 5, seed));
    }
}

TEST(NumberSearch, gives_parts_left_over_the_numbers_of_their_group) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::mt19937_64 engine(seed);
        NumberRule rule{12, 1, false};
        rule.shape = {seed % 2 == 0 ? 3 : 4, false, seed % 4 == 1 ? 2 : 0};
        Overlaps overlaps = random_overlaps(rule, 3, seed);
        std::erase_if(overlaps,
                      [&](const Overlap& o) { return !rule.is_in_group(o.part, o.origin); });
        const Numbers numbers = greedy_numbers(rule, overlaps);
        SCOPED_TRACE(seed);
        for (Part part = 0; part < rule.num_parts; ++part)
            EXPECT_EQ(rule.group_of_part(numbers[static_cast<std::size_t>(part)]),
                      rule.group_of_part(part));
    }
}

TEST(NumberSearch, ends_soon_if_one_rank_has_all_numbers) {
    // Work in the square of the parts does not end within the time-out.
    constexpr int num_parts = 1 << 17;
    const NumberRule rule{num_parts, 2, true, {}};
    Overlaps overlaps;
    for (Part part = 0; part < num_parts; ++part) overlaps.push_back({part < 99 ? 1 : 0, part, 7});
    const Numbers numbers = greedy_numbers(rule, overlaps);
    EXPECT_EQ(numbers.front(), num_parts / 2);
    EXPECT_EQ(numbers.back(), num_parts - 1);
}

}  // namespace
}  // namespace rrcb
