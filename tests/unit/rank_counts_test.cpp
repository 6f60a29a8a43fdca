// Counts of many ranks in one process reach the ranks that they are for.
#include "../support/common.hpp"
#include "../support/virtual_butterfly.hpp"
#include "collective/rank_counts_mpi.hpp"

namespace rrcb {
namespace {

/// What each rank has for others.
using Counts = std::vector<std::map<int, LocalIndex>>;

/// For the ranks next to each in a cube of them, and for itself.
Counts counts_for_neighbours(int side) {
    Counts counts;
    const auto outside = [&](int x) { return x < 0 || x >= side; };
    for (int rank = 0; rank < side * side * side; ++rank) {
        auto& to = counts.emplace_back();
        for (int k = 0; k < 27; ++k) {
            const int x = rank % side + k % 3 - 1;
            const int y = rank / side % side + k / 3 % 3 - 1;
            const int z = rank / side / side + k / 9 - 1;
            if (outside(x) || outside(y) || outside(z)) continue;
            to[x + side * (y + side * z)] = static_cast<LocalIndex>(rank + 1);
        }
    }
    return counts;
}

/// For so many ranks anywhere; every fifth rank has none.
Counts scattered_counts(int num_ranks, int num_each) {
    std::mt19937_64 random(static_cast<unsigned>(num_ranks));
    Counts counts(static_cast<std::size_t>(num_ranks));
    for (std::size_t rank = 0; rank < counts.size(); ++rank)
        for (int k = 0; k < (rank % 5 == 0 ? 0 : num_each); ++k)
            counts[rank][static_cast<int>(random() % counts.size())] = random() % 1000 + 1;
    return counts;
}

/// Sends the counts, and checks that all arrive.
test::PassCounts expect_all(const Counts& sent) {
    const auto num_ranks = static_cast<int>(sent.size());
    std::vector<Butterfly> all;
    Counts expected(sent.size());
    for (int rank = 0; rank < num_ranks; ++rank) {
        std::vector<RankCount> to;
        for (const auto& [other, count] : sent[static_cast<std::size_t>(rank)]) {
            to.push_back({other, count});
            expected[static_cast<std::size_t>(other)][rank] = count;
        }
        add_counts(to, all.emplace_back(rank, num_ranks, nullptr));
    }
    const test::PassCounts pass = test::run_pass(
        all, Butterfly::to_owners, std::vector<Flags>(sent.size()), [](int, int) { return false; });
    for (std::size_t rank = 0; rank < sent.size(); ++rank) {
        std::map<int, LocalIndex> from;
        int last = -1;
        for (const RankCount& one : counts_in(all[rank])) {
            EXPECT_LT(std::exchange(last, one.rank), one.rank);
            from[one.rank] = one.count;
        }
        EXPECT_EQ(from, expected[rank]);
    }
    return pass;
}

TEST(RankCounts, reach_their_ranks_whatever_these_are) {
    expect_all({{}});
    expect_all({{{0, 3}}});
    for (const int num_ranks : {2, 3, 5, 7, 8, 10, 33, 64})
        for (const int num_each : {0, 1, 4, 200}) expect_all(scattered_counts(num_ranks, num_each));
}

TEST(RankCounts, are_of_64_bits) {
    const LocalIndex most = std::numeric_limits<LocalIndex>::max();
    // A number that is no double, and words that are a signalling NaN.
    expect_all({{{1, (LocalIndex{1} << 60) + 1}, {2, 0x7ff0000000000001u}}, {{1, most}}, {}});
}

/// The counts arrive, and no message and no rank gets more bytes than these.
void expect_short(const Counts& counts, std::size_t longest, std::size_t most_bytes_in) {
    const test::PassCounts pass = expect_all(counts);
    EXPECT_LE(pass.longest, longest);
    EXPECT_LE(pass.most_bytes_in, most_bytes_in);
    testing::Test::RecordProperty("bytes", std::to_string(pass.longest) + " longest, " +
                                               std::to_string(pass.most_bytes_in) + " into a rank");
}

TEST(RankCounts, of_64000_ranks_for_those_next_to_them_take_short_messages) {
    expect_short(counts_for_neighbours(40), 1000, 8000);
}

TEST(RankCounts, of_4096_ranks_for_any_take_short_messages) {
    expect_short(scattered_counts(4096, 50), 2000, 16000);
}

}  // namespace
}  // namespace rrcb
