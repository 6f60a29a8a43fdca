#include "passes/bins.hpp"

#include "../support/common.hpp"

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

TEST(Bins, of_equal_width_are_where_they_are_worked_out_by_hand) {
    const Bins bins(2, 10, false, 4);
    for (int k = 0; k <= 4; ++k) EXPECT_EQ(bins.edge(k), 2 + 2 * k);
    EXPECT_EQ(bins.slot_of(1.9), 0);
    EXPECT_EQ(bins.slot_of(2), 1);
    EXPECT_EQ(bins.slot_of(3.9), 1);
    EXPECT_EQ(bins.slot_of(4), 2);
    EXPECT_EQ(bins.slot_of(9.9), 4);
    EXPECT_EQ(bins.slot_of(10), 5);
}

TEST(Bins, of_equal_numbers_of_doubles_double_their_edges_from_power_to_power) {
    // Between 1 and 16 lie as many doubles in each octave.
    const Bins bins(1, 16, true, 4);
    for (int k = 0; k <= 4; ++k) EXPECT_EQ(bins.edge(k), std::exp2(k));
    EXPECT_EQ(bins.slot_of(7.99), 3);
    EXPECT_EQ(bins.slot_of(8), 4);
}

TEST(Bins, of_fewer_doubles_than_bins_hold_one_each) {
    const double next = std::nextafter(1.0, 2);
    const Bins bins(1, std::nextafter(next, 2), true, 64);
    EXPECT_EQ(bins.edge(1), next);
    EXPECT_EQ(bins.slot_of(1), 1);
    EXPECT_EQ(bins.slot_of(next), 2);
    EXPECT_EQ(bins.edge(3), bins.edge(64));
}

TEST(Bins, count_both_zeros_as_one) {
    const Bins bins(-1, 1, true, 64);
    EXPECT_EQ(bins.slot_of(-0.0), bins.slot_of(0.0));
}

TEST(Bins, hold_each_value_between_their_edges) {
    std::mt19937_64 engine(11);
    std::uniform_real_distribution<double> exponent(-320, 308);
    std::uniform_real_distribution<double> share(-0.1, 1.1);
    const std::vector<std::pair<double, double>> brackets{
        {0, 1},        {-largest, infinity}, {-1e-310, 1e-310}, {5e-324, 1e300},
        {-3, -1e-300}, {1e9, 1e9 + 1e-6},    {0, 5e-324},       {-largest, largest}};
    for (const auto& [lower, upper] : brackets) {
        for (const bool by_bits : {false, true}) {
            const Bins bins(lower, upper, by_bits, 64);
            for (int k = 0; k < 64; ++k) EXPECT_LE(bins.edge(k), bins.edge(k + 1));
            EXPECT_EQ(bins.edge(0), lower);
            EXPECT_EQ(bins.edge(64), upper);
            for (int i = 0; i < 2000; ++i) {
                const double sign = i % 2 == 0 ? 1 : -1;
                const double value =
                    i % 3 == 0 ? sign * std::pow(10, exponent(engine))
                               : std::lerp(lower, std::min(upper, largest), share(engine));
                if (std::isinf(value)) continue;
                const int slot = bins.slot_of(value);
                EXPECT_GE(value, slot > 0 ? bins.edge(slot - 1) : -infinity);
                EXPECT_LT(value, slot <= 64 ? bins.edge(slot) : infinity);
            }
        }
    }
}

}  // namespace
}  // namespace rrcb
