#include "lists/hungarian.hpp"

#include "../support/clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace rrcb {
namespace {

GlobalCount sum_of(std::span<const Gain> gains, std::span<const Part> numbers) {
    GlobalCount sum = 0;
    for (const Gain& gain : gains) {
        if (numbers[static_cast<std::size_t>(gain.part)] == gain.number) sum += gain.value;
    }
    return sum;
}

std::vector<Gain> random_gains(int num_parts, int count, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::vector<Gain> gains;
    const auto draw = [&](int end) { return static_cast<Part>(test::uniform(engine, 0, end)); };
    for (int i = 0; i < count; ++i) {
        gains.push_back({draw(num_parts), draw(num_parts), draw(1000)});
    }
    return gains;
}

TEST(Hungarian, gives_up_the_largest_gain_for_a_larger_sum) {
    // 0 -> 0 alone is the best pair, but 0 -> 1 with 1 -> 0 brings 9 + 9 > 10.
    const std::vector<Gain> gains = {{0, 0, 10}, {0, 1, 9}, {1, 0, 9}};
    EXPECT_EQ(best_numbers(gains, 2), (std::vector<Part>{1, 0}));
}

TEST(Hungarian, is_the_best_of_all_permutations) {
    for (unsigned seed = 0; seed < 50; ++seed) {
        const std::vector<Gain> gains = random_gains(6, 14, seed);
        std::vector<Part> numbers(6);
        std::iota(numbers.begin(), numbers.end(), 0);
        GlobalCount best = 0;
        do {
            best = std::max(best, sum_of(gains, numbers));
        } while (std::ranges::next_permutation(numbers).found);
        EXPECT_EQ(sum_of(gains, best_numbers(gains, 6)), best);
    }
}

TEST(Hungarian, keeps_numbers_among_equals) {
    const std::vector<Gain> gains = {{0, 0, 5}, {0, 2, 5}, {2, 0, 5}, {2, 2, 5}};
    EXPECT_EQ(best_numbers(gains, 4), (std::vector<Part>{0, 1, 2, 3}));
}

TEST(Hungarian, of_many_parts_is_a_permutation_and_undoes_a_shift) {
    constexpr int num_parts = 1000;
    std::vector<Gain> gains = random_gains(num_parts, 5000, 1);
    for (Part part = 0; part < num_parts - 1; ++part) gains.push_back({part, part + 1, 100000});
    std::vector<Part> numbers = best_numbers(gains, num_parts);
    EXPECT_EQ(numbers[0], 1);
    EXPECT_EQ(numbers[num_parts - 2], num_parts - 1);
    std::ranges::sort(numbers);
    for (Part part = 0; part < num_parts; ++part) {
        EXPECT_EQ(numbers[static_cast<std::size_t>(part)], part);
    }
}

}  // namespace
}  // namespace rrcb
