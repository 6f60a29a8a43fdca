// The search for numbers of parts by many ranks in one process, compared with the greedy method at
// one place.
#include "lists/number_search.hpp"

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/part_ranks.hpp"
#include "../support/virtual_butterfly.hpp"

namespace rrcb {
namespace {

using Overlaps = std::vector<Overlap>;
using Numbers = std::vector<Part>;

Numbers unchanged(int num_parts) {
    Numbers numbers(static_cast<std::size_t>(num_parts));
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

/// Steps of all ranks, as find_numbers() takes them.
class ManyRanks {
  public:
    ManyRanks(const NumberRule& rule, const Overlaps& overlaps)
        : rule_(rule), flags_(static_cast<std::size_t>(rule.num_ranks)) {
        for (int rank = 0; rank < rule.num_ranks; ++rank) {
            searches_.emplace_back(rule, rank);
            told_.emplace_back(rank, rule.num_ranks, NumberSearch::add_up);
            offers_.emplace_back(rank, rule.num_ranks, NumberSearch::append);
            left_.emplace_back(rank, rule.num_ranks, NumberSearch::append);
        }
        hand_in(overlaps);
    }

    Numbers run(int most_rounds = 1 << 20) {
        if (exchange_offers(most_rounds)) join_what_is_left();
        Numbers numbers(static_cast<std::size_t>(rule_.num_parts), no_part);
        for (const NumberSearch& search : searches_)
            std::ranges::copy(search.numbers(), numbers.begin() + search.parts().first);
        return numbers;
    }

    int num_rounds = 0;
    std::int64_t num_left = 0;
    std::size_t longest = 0;        ///< message, in bytes
    std::size_t most_bytes_in = 0;  ///< into a rank in one pass

    /// All points, and those kept under the old numbers and the new.
    std::array<GlobalCount, 3> count_points() const {
        std::array<GlobalCount, 3> sums{};
        for (const NumberSearch& search : searches_)
            for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += search.count_points()[k];
        return sums;
    }

  private:
    template <class Step>
    void for_each(Step&& step) {
        for (std::size_t rank = 0; rank < searches_.size(); ++rank) step(rank);
    }

    void pass(std::vector<Butterfly>& all, Butterfly::Direction direction) {
        const auto counts = test::run_pass(all, direction, flags_, [](int, int) { return false; });
        longest = std::max(longest, counts.longest);
        most_bytes_in = std::max(most_bytes_in, counts.most_bytes_in);
    }

    /// Overlaps with earlier parts come from two ranks each, in halves.
    void hand_in(const Overlaps& overlaps) {
        std::vector<Overlaps> of_ranks(searches_.size());
        for (const auto& [origin, part, count] : overlaps) {
            const auto rank =
                static_cast<std::size_t>(rule_.by_rank ? origin : part) % searches_.size();
            const GlobalCount here = rule_.by_rank ? count : count / 2;
            of_ranks[rank].push_back({origin, part, here});
            if (here < count)
                of_ranks[(rank + 1) % searches_.size()].push_back({origin, part, count - here});
        }
        for_each([&](std::size_t rank) {
            // One of two halves on the same rank, where there is but one.
            std::map<std::pair<Part, std::int32_t>, GlobalCount> sums;
            for (const auto& [origin, part, count] : of_ranks[rank]) sums[{part, origin}] += count;
            Overlaps mine;
            for (const auto& [pair, count] : sums) mine.push_back({pair.second, pair.first, count});
            searches_[rank].hand_in(mine, told_[rank]);
        });
        pass(told_, Butterfly::to_owners);
        for_each([&](std::size_t rank) { searches_[rank].start(told_[rank].owned()); });
    }

    bool exchange_offers(int most_rounds) {
        for (bool refuses = true; refuses && num_rounds < most_rounds; ++num_rounds) {
            bool moves = false;
            refuses = false;
            for_each([&](std::size_t rank) {
                offers_[rank].clear();
                moves = searches_[rank].offer(offers_[rank]) || moves;
            });
            pass(offers_, Butterfly::to_owners);
            if (num_rounds == 0 && !moves) return false;
            for_each([&](std::size_t rank) {
                refuses = searches_[rank].choose(offers_[rank]) || refuses;
            });
            pass(offers_, Butterfly::back);
            for_each([&](std::size_t rank) { searches_[rank].follow(offers_[rank]); });
        }
        return true;
    }

    void join_what_is_left() {
        std::vector<NumberSearch::Counts> before(1);
        for_each([&](std::size_t rank) {
            const auto [parts, numbers] = searches_[rank].left();
            before.push_back({before.back()[0] + parts, before.back()[1] + numbers});
        });
        num_left = before.back()[0];
        EXPECT_EQ(num_left, before.back()[1]);
        for_each([&](std::size_t rank) { searches_[rank].meet(before[rank], left_[rank]); });
        pass(left_, Butterfly::to_owners);
        for (Butterfly& left : left_)
            left.owned().for_each([&](const Record& met) { left.answer(met.key, met.payload); });
        pass(left_, Butterfly::back);
        for_each([&](std::size_t rank) { searches_[rank].take(before[rank], left_[rank]); });
    }

    NumberRule rule_;
    std::vector<NumberSearch> searches_;
    std::vector<Butterfly> told_;
    std::vector<Butterfly> offers_;
    std::vector<Butterfly> left_;
    std::vector<Flags> flags_;
};

/// Origin of each part by the greedy method, the largest overlap first; no_part where the parts
/// left have none.
std::vector<std::int32_t> greedy_origins(const NumberRule& rule, Overlaps overlaps) {
    std::map<std::int32_t, int> num_free;
    for (Part part = 0; part < rule.num_parts; ++part) {
        ++num_free[rule.home_of(part)];
        overlaps.push_back({rule.home_of(part), part, 0});
    }
    std::ranges::sort(overlaps, {}, [&](const Overlap& o) {
        return std::tuple(-o.count, rule.home_of(o.part) != o.origin, o.part, o.origin);
    });
    std::vector<std::int32_t> origins(static_cast<std::size_t>(rule.num_parts), no_part);
    for (const auto& [origin, part, count] : overlaps) {
        if (origins[static_cast<std::size_t>(part)] != no_part || num_free[origin] == 0) continue;
        origins[static_cast<std::size_t>(part)] = origin;
        --num_free[origin];
    }
    return origins;
}

void expect_greedy(const NumberRule& rule, const Overlaps& overlaps, const Numbers& numbers) {
    Numbers sorted = numbers;
    std::ranges::sort(sorted);
    EXPECT_EQ(sorted, unchanged(rule.num_parts));
    const std::vector<std::int32_t> expected = greedy_origins(rule, overlaps);
    for (std::size_t part = 0; part < numbers.size(); ++part) {
        if (expected[part] == no_part) continue;
        ASSERT_EQ(rule.home_of(numbers[part]), expected[part]) << "part " << part;
        // Parts of one origin keep their number.
        if (rule.home_of(static_cast<Part>(part)) == expected[part]) {
            EXPECT_EQ(numbers[part], static_cast<Part>(part));
        }
    }
}

GlobalCount kept_under(const Numbers& numbers, const NumberRule& rule, const Overlaps& overlaps) {
    GlobalCount kept = 0;
    for (const auto& [origin, part, count] : overlaps)
        if (rule.home_of(numbers[static_cast<std::size_t>(part)]) == origin) kept += count;
    return kept;
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
        rule.is_spread = seed % 7 != 0;
        SCOPED_TRACE(seed);
        const Overlaps overlaps = random_overlaps(rule, 1 + static_cast<int>(seed % 9), seed);
        ManyRanks ranks(rule, overlaps);
        const Numbers numbers = ranks.run();
        expect_greedy(rule, overlaps, numbers);
        const auto [points, before, after] = ranks.count_points();
        EXPECT_EQ(points, std::accumulate(overlaps.begin(), overlaps.end(), GlobalCount{0},
                                          [](GlobalCount sum, const Overlap& overlap) {
                                              return sum + overlap.count;
                                          }));
        EXPECT_EQ(before, kept_under(unchanged(rule.num_parts), rule, overlaps));
        EXPECT_EQ(after, kept_under(numbers, rule, overlaps));
    }
}

TEST(NumberSearch, takes_any_numbers_of_parts_on_the_ranks) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        std::mt19937_64 engine(seed);
        std::vector<RankRange> listed;
        for (int rank = 0; rank < 6; ++rank)
            listed.insert(listed.end(), engine() % 5, RankRange{rank, 1});
        listed.push_back({6, 1});
        NumberRule rule{static_cast<int>(listed.size()), 9, true, seed % 2 == 0, listed};
        SCOPED_TRACE(seed);
        const Overlaps overlaps = random_overlaps(rule, 5, seed);
        expect_greedy(rule, overlaps, ManyRanks(rule, overlaps).run());
    }
}

TEST(NumberSearch, uses_each_number_once_however_few_the_rounds) {
    for (const bool by_rank : {true, false}) {
        for (int rounds = 1; rounds < 6; ++rounds) {
            const NumberRule rule{60, 31, by_rank, true};
            Numbers numbers = ManyRanks(rule, random_overlaps(rule, 12, 5)).run(rounds);
            std::ranges::sort(numbers);
            EXPECT_EQ(numbers, unchanged(60));
        }
    }
}

TEST(NumberSearch, places_all_but_few_parts_if_a_chain_of_refusals_is_cut_off) {
    // Each part but the first is refused by its own rank, a round after the part before it was.
    constexpr int num_ranks = 100;
    const NumberRule rule{num_ranks, num_ranks, true, true};
    Overlaps overlaps{{0, num_ranks - 1, 3 * num_ranks}};
    for (int part = 0; part < num_ranks; ++part) {
        overlaps.push_back({part, part, 2 * (num_ranks - part)});
        if (part + 1 < num_ranks) overlaps.push_back({part + 1, part, 2 * (num_ranks - part) - 1});
    }
    ManyRanks all(rule, overlaps);
    expect_greedy(rule, overlaps, all.run());
    EXPECT_EQ(all.num_rounds, num_ranks);
    ManyRanks few(rule, overlaps);
    few.run(16);
    EXPECT_EQ(few.num_left, 1);
    const auto [points, before, after] = few.count_points();
    EXPECT_GT(after, before);
}

/// Sub-domains in a square grid, row by row, of which a share of the points lies in neighbours to
/// the right and above.
Overlaps drifted(int side, double share) {
    Overlaps overlaps;
    std::mt19937_64 engine(1);
    const int num_ranks = side * side;
    for (int rank = 0; rank < num_ranks; ++rank)
        for (const int step : {0, 1, side, side + 1}) {
            const double count = step == 0 ? 1 - share : share * test::uniform(engine, 0, 1);
            overlaps.push_back(
                {rank, (rank + step) % num_ranks, static_cast<GlobalCount>(1 + 50000 * count)});
        }
    return overlaps;
}

TEST(NumberSearch, of_thousands_of_ranks_takes_few_rounds_and_short_messages) {
    constexpr int side = 64;
    const NumberRule rule{side * side, side * side, true, true};
    for (const double share : {0.1, 0.6, 0.9}) {
        const Overlaps overlaps = drifted(side, share);
        ManyRanks ranks(rule, overlaps);
        expect_greedy(rule, overlaps, ranks.run());
        EXPECT_LE(ranks.num_rounds, share < 0.5 ? 0 : 6);
        EXPECT_LE(ranks.longest, 400u);
        EXPECT_LE(ranks.most_bytes_in, 2000u);
    }
}

}  // namespace
}  // namespace rrcb
