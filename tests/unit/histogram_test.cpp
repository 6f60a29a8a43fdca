#include "search/histogram.hpp"

#include "search/sample.hpp"

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
    histogram[HistogramLayout::sample_dimension] = 0;
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

TEST(Histogram, of_samples_holds_the_positions_of_both) {
    std::vector<double> one = empty();
    std::vector<double> other = empty();
    add_to_sample(5, {1, 2}, 2, clear_to_sample(2, one));
    add_to_sample(7, {3, 4}, 2, clear_to_sample(2, other));
    join_histograms(other, one);
    EXPECT_EQ(positions_in(sample_in(one), 2), (std::vector<Vector>{{3, 4}, {1, 2}}));
}

}  // namespace
}  // namespace rrcb
