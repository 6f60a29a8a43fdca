#include "passes/histogram.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace rrcb {
namespace {

constexpr HistogramLayout layout{2};  // four slots

std::vector<double> empty() {
    std::vector<double> histogram(layout.length());
    clear_histogram(histogram);
    return histogram;
}

TEST(Histogram, that_is_empty_leaves_another_as_it_is) {
    std::vector<double> histogram(layout.length());
    for (std::size_t k = 0; k < histogram.size(); ++k) histogram[k] = static_cast<double>(k) - 3;
    const std::vector<double> before = histogram;
    join_histograms(empty(), histogram);
    EXPECT_EQ(histogram, before);
}

TEST(Histogram, is_joined_by_the_largest_extent_and_the_sums_of_all_slots) {
    std::vector<double> one = empty();
    std::vector<double> other = empty();
    one[0] = -2;                 // from 2 ...
    one[max_dimension] = 3;      // ... to 3
    other[0] = 1;                // from -1 ...
    other[max_dimension] = 2.5;  // ... to 2.5
    for (std::size_t k = layout.num_extents; k < layout.length(); ++k) {
        one[k] = static_cast<double>(k);
        other[k] = 100;
    }
    join_histograms(other, one);
    EXPECT_EQ(one[0], 1);
    EXPECT_EQ(one[max_dimension], 3);
    EXPECT_EQ(one[1], -std::numeric_limits<double>::infinity()) << "nobody told of this axis";
    for (std::size_t k = layout.num_extents; k < layout.length(); ++k)
        EXPECT_EQ(one[k], static_cast<double>(k) + 100);
}

}  // namespace
}  // namespace rrcb
