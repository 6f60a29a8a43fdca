// The order of entries by rank, against a stable sort.
#include "collective/rank_order.hpp"

#include "../support/common.hpp"

namespace rrcb {
namespace {

std::vector<int> random_ranks(std::size_t count, int num_ranks) {
    std::mt19937_64 random(count);
    std::vector<int> ranks(count);
    // The first rank, the last one, and few others often.
    for (int& rank : ranks) {
        const auto one = static_cast<int>(random() % static_cast<unsigned>(num_ranks));
        const unsigned kind = static_cast<unsigned>(random() % 4);
        rank = kind == 0 ? 0 : kind == 1 ? num_ranks - 1 : kind == 2 ? one - one % 1000 : one;
    }
    return ranks;
}

void expect_counts(const std::vector<RankCount>& counts, const std::vector<int>& ranks) {
    std::map<int, LocalIndex> expected;
    for (const int rank : ranks) ++expected[rank];
    ASSERT_EQ(counts.size(), expected.size());
    auto next = expected.begin();
    for (const RankCount& one : counts) {
        EXPECT_EQ(one.rank, next->first);
        EXPECT_EQ(one.count, (next++)->second);
    }
}

TEST(RankOrder, is_that_of_a_stable_sort) {
    for (const int num_ranks : {1, 2, 3, 1023, 1024, 1025, 70000, 1 << 20, (1 << 20) + 1,
                                std::numeric_limits<int>::max()}) {
        for (const std::size_t count : {0U, 1U, 7U, 5000U}) {
            const std::vector<int> ranks = random_ranks(count, num_ranks);
            std::vector<std::size_t> expected(count);
            std::iota(expected.begin(), expected.end(), std::size_t{0});
            std::ranges::stable_sort(expected, {}, [&](std::size_t k) { return ranks[k]; });
            RankOrder order(ranks, num_ranks);
            expect_counts(order.counts(), ranks);
            std::vector<std::size_t> found(count, count);
            std::size_t num_visits = 0;
            order.for_each([&](std::size_t k, std::size_t place) {
                found[place] = k;
                ++num_visits;
            });
            EXPECT_EQ(found, expected) << num_ranks << " ranks";
            EXPECT_EQ(num_visits, count);
        }
    }
}

TEST(RankOrder, of_an_ascending_list_is_counted) {
    for (const std::size_t count : {0U, 1U, 7U, 5000U}) {
        std::vector<int> ranks = random_ranks(count, 3000);
        std::ranges::sort(ranks);
        expect_counts(count_ascending(ranks), ranks);
    }
}

}  // namespace
}  // namespace rrcb
