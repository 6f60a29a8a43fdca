#include "arithmetic/running_sums.hpp"

#include <gtest/gtest.h>

namespace rrcb {
namespace {

int num_additions = 0;

/// A sum that counts additions.
struct Counted {
    double value = 0;

    void operator+=(const Counted& other) {
        value += other.value;
        ++num_additions;
    }
};

TEST(RunningSums, of_all_bins_are_found_by_as_many_additions_as_there_are_bins) {
    constexpr int num_bins = 1000;
    RunningSums<Counted> sums(num_bins);
    for (int bin = 0; bin < num_bins; ++bin) sums[bin] += {1.0 + bin};
    sums.empty();
    num_additions = 0;
    for (int bin = 0; bin < num_bins; ++bin) EXPECT_EQ(sums.totals()[bin].value, 1.0 + bin);
    EXPECT_LE(num_additions, num_bins);
}

TEST(RunningSums, go_on_after_their_totals_were_read) {
    RunningSums<double> sums(2);
    for (int k = 1; k <= 200; ++k) {
        sums[1] += 1;
        sums.empty();
        EXPECT_EQ(sums.totals()[1], k);
    }
}

}  // namespace
}  // namespace rrcb
