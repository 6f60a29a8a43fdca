#include "lists/rank_numbers.hpp"

#include "../support/clouds.hpp"
#include "lists/hungarian.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace rrcb {
namespace {

/// Counts that keep their rank.
GlobalCount kept(std::span<const Overlap> overlaps, std::span<const Part> numbers,
                 std::span<const RankRange> homes) {
    GlobalCount sum = 0;
    for (const Overlap& overlap : overlaps) {
        const Part number = numbers[static_cast<std::size_t>(overlap.part)];
        if (homes[static_cast<std::size_t>(number)].first_rank == overlap.origin)
            sum += overlap.count;
    }
    return sum;
}

/// That many parts on the ranks 0, 1, ...
std::vector<RankRange> homes_of(std::initializer_list<int> parts_of_ranks) {
    std::vector<RankRange> homes;
    int rank = 0;
    for (const int parts : parts_of_ranks)
        homes.insert(homes.end(), static_cast<std::size_t>(parts), RankRange{rank++, 1});
    return homes;
}

bool is_permutation(std::vector<Part> numbers) {
    std::ranges::sort(numbers);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] != static_cast<Part>(i)) return false;
    return true;
}

TEST(RankNumbers, stay_where_nothing_is_gained) {
    const auto homes = homes_of({2, 3});
    EXPECT_EQ(numbers_by_rank({}, homes), (std::vector<Part>{0, 1, 2, 3, 4}));
    const std::vector<Overlap> equal = {{0, 0, 5}, {1, 0, 5}, {0, 4, 5}, {1, 4, 5}};
    EXPECT_EQ(numbers_by_rank(equal, homes), (std::vector<Part>{0, 1, 2, 3, 4}));
}

TEST(RankNumbers, go_with_the_points_as_far_as_a_rank_has_numbers) {
    // All parts come from rank 1, which has room for two: the heaviest of them. Part 3 keeps its
    // number, part 0 gets the one that is left, the others go where numbers are left.
    const auto homes = homes_of({2, 2});
    const std::vector<Overlap> overlaps = {{1, 0, 9}, {1, 1, 2}, {1, 2, 3}, {1, 3, 8}};
    EXPECT_EQ(numbers_by_rank(overlaps, homes), (std::vector<Part>{2, 1, 0, 3}));
}

TEST(RankNumbers, pass_ranks_without_parts) {
    const auto homes = homes_of({1, 0, 2, 0});
    const std::vector<Overlap> overlaps = {{1, 0, 9}, {3, 1, 9}, {0, 2, 4}, {2, 0, 1}};
    EXPECT_EQ(numbers_by_rank(overlaps, homes), (std::vector<Part>{2, 1, 0}));
}

TEST(RankNumbers, keep_at_least_half_of_the_best_and_mostly_all_but_little) {
    double worst = 1, sum = 0;
    constexpr unsigned num_cases = 200;
    for (unsigned seed = 0; seed < num_cases; ++seed) {
        std::mt19937_64 engine(seed);
        const auto draw = [&](int end) { return static_cast<int>(test::uniform(engine, 0, end)); };
        const auto homes = homes_of({draw(9), 1 + draw(9), draw(9), 1 + draw(9)});
        const int num_parts = static_cast<int>(homes.size());
        std::vector<Overlap> overlaps;
        for (Part part = 0; part < num_parts; ++part)
            for (int rank = 0; rank < 4; ++rank) overlaps.push_back({rank, part, draw(100)});
        std::vector<Gain> gains;
        for (const Overlap& overlap : overlaps)
            for (Part number = 0; number < num_parts; ++number)
                if (homes[static_cast<std::size_t>(number)].first_rank == overlap.origin)
                    gains.push_back({overlap.part, number, overlap.count});
        const auto numbers = numbers_by_rank(overlaps, homes);
        ASSERT_TRUE(is_permutation(numbers));
        const double share =
            static_cast<double>(kept(overlaps, numbers, homes)) /
            static_cast<double>(kept(overlaps, best_numbers(gains, num_parts), homes));
        worst = std::min(worst, share);
        sum += share;
    }
    EXPECT_GE(worst, 0.5);
    EXPECT_GT(sum / num_cases, 0.9);
}

TEST(RankNumbers, of_many_parts_bring_every_point_home) {
    // The parts of rank r lie on rank r + 1: as many overlaps as parts, whatever a rank has.
    constexpr int num_parts = 300000;
    const auto homes = homes_of({num_parts / 3, num_parts / 3, num_parts / 3});
    std::vector<Overlap> overlaps;
    for (Part part = 0; part < num_parts; ++part)
        overlaps.push_back({(homes[static_cast<std::size_t>(part)].first_rank + 1) % 3, part, 2});
    const auto numbers = numbers_by_rank(overlaps, homes);
    EXPECT_TRUE(is_permutation(numbers));
    EXPECT_EQ(kept(overlaps, numbers, homes), 2 * num_parts);
}

}  // namespace
}  // namespace rrcb
