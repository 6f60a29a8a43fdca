// The search for numbers of parts by many ranks in one process, beside the search at one place.
#include "lists/number_search.hpp"

#include "../support/clouds.hpp"
#include "../support/part_ranks.hpp"
#include "../support/virtual_butterfly.hpp"
#include "lists/hungarian.hpp"
#include "lists/rank_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace rrcb {
namespace {

using Overlaps = std::vector<Overlap>;

/// Steps of all ranks, as remap_spread() takes them.
class ManyRanks {
  public:
    ManyRanks(int num_parts, int num_ranks, Origins origins, const Overlaps& overlaps)
        : rule_{num_parts, num_ranks, origins}, flags_(static_cast<std::size_t>(num_ranks)) {
        for (int rank = 0; rank < num_ranks; ++rank) {
            searches_.emplace_back(num_parts, num_ranks, rank);
            offers_.emplace_back(rank, num_ranks, NumberSearch::keep_larger);
            left_.emplace_back(rank, num_ranks, NumberSearch::unite);
        }
        std::vector<Overlaps> of_ranks(searches_.size());
        for (const Overlap& overlap : overlaps) {
            const bool by_rank = origins == Origins::ranks;
            const int rank = by_rank ? overlap.origin : rule_.rank_of(overlap.origin);
            of_ranks[static_cast<std::size_t>(rank)].push_back(overlap);
        }
        for (std::size_t rank = 0; rank < searches_.size(); ++rank)
            searches_[rank].start(origins, of_ranks[rank]);
    }

    /// New numbers of all parts, as their ranks know them.
    std::vector<Part> run(int most_rounds = 1 << 20) {
        std::vector<Part> numbers(static_cast<std::size_t>(rule_.num_parts));
        std::iota(numbers.begin(), numbers.end(), 0);
        if (!exchange_offers(most_rounds)) return numbers;
        join_what_is_left();
        for_each([&](std::size_t rank) { left_[rank].clear(); });
        for_each([&](std::size_t rank) { searches_[rank].tell(touched(rank), left_[rank]); });
        pass(left_, Butterfly::to_owners);
        for_each([&](std::size_t rank) { searches_[rank].conclude(left_[rank]); });
        pass(left_, Butterfly::back);
        for_each([&](std::size_t rank) { note(rank, numbers); });
        return numbers;
    }

    int num_rounds = 0;
    std::int64_t num_left = 0;
    std::size_t longest = 0;        ///< message, in bytes
    std::size_t most_bytes_in = 0;  ///< into a rank in one pass

    NumberSearch::Kept kept() const {
        NumberSearch::Kept sum;
        for (const NumberSearch& search : searches_) {
            sum.before += search.kept().before;
            sum.after += search.kept().after;
        }
        return sum;
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

    bool exchange_offers(int most_rounds) {
        for (int round = 0; round < most_rounds; ++round) {
            auto most = NumberSearch::News::none;
            for_each([&](std::size_t rank) {
                offers_[rank].clear();
                most = std::max(most, searches_[rank].offer(offers_[rank]));
            });
            pass(offers_, Butterfly::to_owners);
            if (round == 0 && most != NumberSearch::News::elsewhere) return false;
            for_each([&](std::size_t rank) { searches_[rank].choose(offers_[rank]); });
            if (most == NumberSearch::News::none) break;
            ++num_rounds;
            pass(offers_, Butterfly::back);
            for_each([&](std::size_t rank) { searches_[rank].follow(offers_[rank]); });
        }
        return true;
    }

    void join_what_is_left() {
        std::vector<NumberSearch::Counts> before(1);
        for_each([&](std::size_t rank) {
            const auto [parts, numbers] = searches_[rank].settle();
            before.push_back({before.back().parts + parts, before.back().numbers + numbers});
        });
        num_left = before.back().parts;
        EXPECT_EQ(num_left, before.back().numbers);
        for_each([&](std::size_t rank) { searches_[rank].meet(before[rank], left_[rank]); });
        pass(left_, Butterfly::to_owners);
        for_each([&](std::size_t rank) { answer_all(left_[rank]); });
        pass(left_, Butterfly::back);
        for_each([&](std::size_t rank) { searches_[rank].take(before[rank], left_[rank]); });
    }

    /// Some parts, of other ranks mostly.
    std::vector<Part> touched(std::size_t rank) const {
        const int part = static_cast<int>(7 * rank + 3) % rule_.num_parts;
        return part == 0 ? std::vector<Part>{0} : std::vector<Part>{part / 2, part};
    }

    void note(std::size_t rank, std::vector<Part>& numbers) {
        const auto result = searches_[rank].result(left_[rank]);
        const auto own = parts_on(static_cast<int>(rank), rule_.num_parts, rule_.num_ranks);
        for (const auto& [part, number] : result) {
            told_.emplace(part, number);
            EXPECT_EQ(told_[part], number);
            if (part >= own.first && part < own.end)
                numbers[static_cast<std::size_t>(part)] = number;
        }
        for (const Part part : touched(rank))
            EXPECT_TRUE(std::ranges::count(result, part, &Numbered::first) == 1);
    }

    NumberRule rule_;
    std::vector<NumberSearch> searches_;
    std::vector<Butterfly> offers_;
    std::vector<Butterfly> left_;
    std::vector<Flags> flags_;
    std::map<Part, Part> told_;
};

/// Overlaps of few counts, so that many are equal, of `per_origin` parts each; some origins have
/// none.
Overlaps random_overlaps(int num_parts, int num_origins, int per_origin, unsigned seed) {
    std::mt19937_64 engine(seed);
    const auto draw = [&](int end) { return static_cast<int>(test::uniform(engine, 0, end)); };
    Overlaps overlaps;
    for (int origin = 0; origin < num_origins; ++origin) {
        if (draw(7) == 0) continue;
        std::vector<Part> parts;
        for (int k = 0; k < per_origin; ++k)
            parts.push_back(draw(2) == 0 ? draw(num_parts) : (origin + draw(5)) % num_parts);
        std::ranges::sort(parts);
        parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
        for (const Part part : parts) overlaps.push_back({origin, part, 1 + draw(4)});
    }
    return overlaps;
}

TEST(NumberSearch, by_ranks_finds_what_one_place_finds) {
    for (unsigned seed = 0; seed < 300; ++seed) {
        const int num_ranks = 1 + static_cast<int>(seed * 13 % 40);
        const int num_parts = num_ranks + static_cast<int>(seed % 3 * seed % 50);
        const Overlaps overlaps =
            random_overlaps(num_parts, num_ranks, 1 + static_cast<int>(seed % 9), seed);
        ManyRanks ranks(num_parts, num_ranks, Origins::ranks, overlaps);
        EXPECT_EQ(ranks.run(),
                  numbers_by_rank(overlaps, test::ranks_of_parts(num_parts, num_ranks)))
            << seed << ": " << num_parts << " parts, " << num_ranks << " ranks";
    }
}

TEST(NumberSearch, by_parts_finds_what_one_place_finds) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        const int num_ranks = 1 + static_cast<int>(seed * 13 % 40);
        const int num_parts = most_parts_exact + 1 + static_cast<int>(seed % 50);
        const Overlaps overlaps =
            random_overlaps(num_parts, num_parts, 1 + static_cast<int>(seed % 9), seed);
        std::vector<Gain> gains;
        for (const auto& [origin, part, count] : overlaps) gains.push_back({part, origin, count});
        ManyRanks ranks(num_parts, num_ranks, Origins::parts, overlaps);
        EXPECT_EQ(ranks.run(), best_numbers(gains, num_parts))
            << seed << ": " << num_parts << " parts, " << num_ranks << " ranks";
    }
}

TEST(NumberSearch, tells_what_is_kept) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const int num_ranks = 17, num_parts = 40;
        const Overlaps overlaps = random_overlaps(num_parts, num_ranks, 6, seed);
        ManyRanks ranks(num_parts, num_ranks, Origins::ranks, overlaps);
        const std::vector<Part> numbers = ranks.run();
        GlobalCount before = 0, after = 0;
        for (const auto& [origin, part, count] : overlaps) {
            const Part number = numbers[static_cast<std::size_t>(part)];
            before += ranks_of_part(part, num_parts, num_ranks).first_rank == origin ? count : 0;
            after += ranks_of_part(number, num_parts, num_ranks).first_rank == origin ? count : 0;
        }
        EXPECT_EQ(ranks.kept().before, before);
        EXPECT_EQ(ranks.kept().after, after);
    }
}

TEST(NumberSearch, uses_each_number_once_however_few_the_rounds) {
    for (int rounds = 1; rounds < 6; ++rounds) {
        const Overlaps overlaps = random_overlaps(60, 31, 12, 5);
        std::vector<Part> numbers = ManyRanks(60, 31, Origins::ranks, overlaps).run(rounds);
        std::ranges::sort(numbers);
        for (Part number = 0; number < 60; ++number)
            ASSERT_EQ(numbers[static_cast<std::size_t>(number)], number);
    }
}

TEST(NumberSearch, places_all_but_few_where_refusals_form_a_chain_that_is_cut_off) {
    // Each rank but the first is refused its own part by the one before, a round after that was.
    constexpr int num_ranks = 100;
    Overlaps overlaps{{num_ranks - 1, 0, 3 * num_ranks}};
    for (int rank = 0; rank < num_ranks; ++rank) {
        overlaps.push_back({rank, rank, 2 * (num_ranks - rank)});
        if (rank + 1 < num_ranks) overlaps.push_back({rank, rank + 1, 2 * (num_ranks - rank) - 1});
    }
    ManyRanks all(num_ranks, num_ranks, Origins::ranks, overlaps);
    EXPECT_EQ(all.run(), numbers_by_rank(overlaps, test::ranks_of_parts(num_ranks, num_ranks)));
    EXPECT_EQ(all.num_rounds, num_ranks);
    ManyRanks few(num_ranks, num_ranks, Origins::ranks, overlaps);
    few.run(16);
    EXPECT_EQ(few.num_left, 1);
    EXPECT_GT(few.kept().after, few.kept().before);
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
    for (const double share : {0.1, 0.9}) {
        const Overlaps overlaps = drifted(side, share);
        ManyRanks ranks(side * side, side * side, Origins::ranks, overlaps);
        EXPECT_EQ(ranks.run(),
                  numbers_by_rank(overlaps, test::ranks_of_parts(side * side, side * side)));
        EXPECT_LE(ranks.num_rounds, share < 0.5 ? 0 : 5);
        EXPECT_LE(ranks.longest, 200u);
        EXPECT_LE(ranks.most_bytes_in, 1100u);
    }
}

}  // namespace
}  // namespace rrcb
