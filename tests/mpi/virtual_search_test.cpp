// Thousands of ranks in one process, through the code that ranks run, find the cuts.
#include "../support/virtual_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace rrcb {
namespace {

using test::Layout;
using test::SearchTotals;
using test::VirtualCloud;
using test::VirtualSearch;

constexpr std::size_t points_per_rank = 8;
constexpr std::size_t kilobyte = 1024;

struct Case {
    int side;
    Layout layout;
    double tolerance;
};

/// Messages of one pass: one from each rank of a set that is halved.
std::int64_t messages_of_pass(std::int64_t num_ranks) {
    if (num_ranks == 1) return 0;
    return num_ranks + messages_of_pass(num_ranks / 2) +
           messages_of_pass(num_ranks - num_ranks / 2);
}

double imbalance_of(std::span<const Part> parts, int num_parts) {
    std::vector<std::size_t> counts(static_cast<std::size_t>(num_parts));
    for (const Part part : parts) ++counts[static_cast<std::size_t>(part)];
    return static_cast<double>(*std::ranges::max_element(counts)) / points_per_rank;
}

class ManySearchers : public testing::TestWithParam<Case> {};

TEST_P(ManySearchers, balance_all_points_by_short_messages_and_little_memory) {
    const auto [side, layout, tolerance] = GetParam();
    const VirtualCloud cloud(side, points_per_rank, layout);
    VirtualSearch ranks(cloud, tolerance);
    const SearchTotals totals = ranks.search();

    const double imbalance = imbalance_of(ranks.parts(), cloud.num_ranks());
    EXPECT_EQ(ranks.imbalance(), imbalance);
    // As even as whole points are.
    EXPECT_LE(imbalance, tolerance > 1 ? 1 + 1.0 / points_per_rank : 1);
    const int levels = std::bit_width(static_cast<unsigned>(cloud.num_ranks())) - 1;
    EXPECT_GE(totals.rounds, levels);
    EXPECT_LE(totals.rounds, 3 * levels);
    EXPECT_EQ(totals.messages.messages, 2 * totals.rounds * messages_of_pass(cloud.num_ranks()));
    if (layout != Layout::scattered) {
        EXPECT_LE(totals.most_into_rank, 64 * kilobyte);
        EXPECT_LE(totals.most_memory, static_cast<std::int64_t>(128 * kilobyte));
    }
    EXPECT_GT(totals.most_memory, 0);
    RecordProperty("rounds", totals.rounds);
    RecordProperty("longest_message_bytes", static_cast<int>(totals.longest()));
    RecordProperty("most_bytes_into_rank", static_cast<int>(totals.most_into_rank));
    RecordProperty("most_memory_bytes", static_cast<int>(totals.most_memory));
}

INSTANTIATE_TEST_SUITE_P(OfManyRanks, ManySearchers,
                         testing::Values(Case{64, Layout::by_part, 1.01},
                                         Case{64, Layout::by_row, 1.0},
                                         Case{16, Layout::scattered, 1.0},
                                         Case{128, Layout::by_part, 1.0}));

}  // namespace
}  // namespace rrcb
