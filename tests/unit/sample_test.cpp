#include "search/sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace rrcb {
namespace {

constexpr int dimension = 2;

std::vector<double> sample_of(LocalIndex begin, LocalIndex end, std::size_t length) {
    std::vector<double> sample(length);
    clear_sample(sample);
    for (LocalIndex i = begin; i < end; ++i)
        add_to_sample(sample_key(0, i), {static_cast<double>(i), 1}, dimension, sample);
    return sample;
}

TEST(Sample, holds_the_positions_of_the_greatest_keys) {
    std::vector<std::pair<double, LocalIndex>> keys;
    for (LocalIndex i = 0; i < 500; ++i) keys.emplace_back(sample_key(0, i), i);
    std::ranges::sort(keys, std::greater<>());
    const auto positions = positions_in(sample_of(0, 500, 3 * 20 + 2), dimension);
    ASSERT_EQ(positions.size(), 20u);
    for (std::size_t k = 0; k < 20; ++k)
        EXPECT_EQ(positions[k][0], static_cast<double>(keys[k].second));
}

TEST(Sample, of_fewer_positions_than_it_has_room_for_holds_all) {
    EXPECT_EQ(positions_in(sample_of(0, 7, 60), dimension).size(), 7u);
    EXPECT_TRUE(positions_in(sample_of(0, 0, 60), dimension).empty());
}

TEST(Sample, is_that_of_the_union_in_whatever_order_parts_are_joined) {
    const auto whole = sample_of(0, 900, 60);
    for (const bool backwards : {false, true}) {
        std::vector<std::vector<double>> parts{sample_of(0, 5, 60), sample_of(5, 600, 60),
                                               sample_of(600, 900, 60)};
        if (backwards) std::ranges::reverse(parts);
        for (std::size_t k = 1; k < 3; ++k) join_samples(parts[k], dimension, parts[0]);
        EXPECT_EQ(parts[0], whole);
    }
}

TEST(Sample, is_spread_evenly_over_what_it_is_taken_from) {
    // 2,000 samples of 20 of 1,000: each tenth gets about 4,000 of the 40,000, give or take five
    // standard deviations (hypergeometric, 59.4 each).
    std::array<int, 10> tenths{};
    for (int rank = 0; rank < 2000; ++rank) {
        std::vector<double> sample(60);
        clear_sample(sample);
        for (LocalIndex i = 0; i < 1000; ++i)
            add_to_sample(sample_key(rank, i), {static_cast<double>(i)}, dimension, sample);
        for (const Vector& x : positions_in(sample, dimension))
            ++tenths[static_cast<std::size_t>(x[0] / 100)];
    }
    for (const int count : tenths) EXPECT_NEAR(count, 4000, 5 * 59.4);
}

}  // namespace
}  // namespace rrcb
