#include "passes/histogram.hpp"

#include "../support/common.hpp"

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

TEST(Histogram, of_points_that_count_as_one_holds_each_number_once) {
    const HistogramLayout counted{.num_bins = 2, .is_weighted = false};
    Collected points;
    points.dimension = 1;
    points.coordinates = {0.1, 0.6, 0.7, 1.5};
    std::vector<double> histogram(counted.length());
    EXPECT_EQ(histogram.size() + counted.num_slots(), layout.length());
    clear_histogram(histogram);
    const Entries all{0, 1, 2, 3};
    count(points, all, 0, Bins(0, 1, false, 2), counted, histogram);
    count_settled({5, 5}, Box{}, 0, counted, histogram);
    EXPECT_EQ((std::vector<double>{5, 1, 2, 1}),
              std::vector<double>(histogram.end() - 4, histogram.end()));
    EXPECT_EQ(weights_in(histogram, counted).data(), counts_in(histogram, counted).data());
}

}  // namespace
}  // namespace rrcb
