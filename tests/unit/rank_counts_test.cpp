// Counts of many ranks in one process reach the ranks that they are for.
#include "../support/virtual_butterfly.hpp"
#include "collective/rank_counts_mpi.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

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

class ManyRanks {
  public:
    ManyRanks(RankCounts::Kind kind, const Counts& sent) : sent_(sent) {
        const auto num_ranks = static_cast<int>(sent.size());
        std::vector<Butterfly> all;
        for (int rank = 0; rank < num_ranks; ++rank) {
            RankCounts& one = counts_.emplace_back(kind, rank, num_ranks);
            std::vector<RankCount> to;
            for (const auto& [other, count] : sent[static_cast<std::size_t>(rank)])
                to.push_back({other, count});
            one.add(to);
            all.push_back(std::move(one.butterfly()));
        }
        pass_ = test::run_pass(all, Butterfly::to_owners, std::vector<Flags>(sent.size()),
                               [](int, int) { return false; });
        for (std::size_t rank = 0; rank < all.size(); ++rank)
            counts_[rank].butterfly() = std::move(all[rank]);
    }

    void expect_sums() const {
        std::vector<LocalIndex> expected(sent_.size());
        for (const auto& to : sent_)
            for (const auto& [rank, count] : to) expected[static_cast<std::size_t>(rank)] += count;
        for (std::size_t rank = 0; rank < sent_.size(); ++rank)
            ASSERT_EQ(counts_[rank].total(), expected[rank]);
    }

    void expect_each() const {
        Counts expected(sent_.size());
        for (std::size_t from = 0; from < sent_.size(); ++from)
            for (const auto& [rank, count] : sent_[from])
                expected[static_cast<std::size_t>(rank)][static_cast<int>(from)] = count;
        for (std::size_t rank = 0; rank < sent_.size(); ++rank) {
            auto next = expected[rank].begin();
            const std::vector<RankCount> from = counts_[rank].from();
            ASSERT_EQ(from.size(), expected[rank].size());
            for (const RankCount& one : from) {
                ASSERT_EQ(one.rank, next->first);
                ASSERT_EQ(one.count, (next++)->second);
            }
        }
    }

    const test::PassCounts& pass() const { return pass_; }

  private:
    const Counts& sent_;
    std::vector<RankCounts> counts_;
    test::PassCounts pass_;
};

void expect_all(const Counts& sent) {
    ManyRanks(RankCounts::sum, sent).expect_sums();
    ManyRanks(RankCounts::each, sent).expect_each();
}

TEST(RankCounts, reach_their_ranks_whatever_these_are) {
    expect_all({{}});
    expect_all({{{0, 3}}});
    for (const int num_ranks : {2, 3, 5, 7, 8, 10, 33, 64})
        for (const int num_each : {0, 1, 4, 200}) expect_all(scattered_counts(num_ranks, num_each));
}

TEST(RankCounts, are_of_64_bits) {
    const LocalIndex most = std::numeric_limits<LocalIndex>::max();
    // A number that is no double, words that are a signalling NaN, and a sum.
    expect_all({{{1, (LocalIndex{1} << 60) + 1}, {2, 0x7ff0000000000001u}},
                {{1, most / 2}, {2, 1}},
                {{0, most}}});
}

/// The counts arrive, and no message and no rank gets more bytes than these.
void expect_short(const std::string& name, RankCounts::Kind kind, const Counts& counts,
                  std::size_t longest, std::size_t most_bytes_in) {
    const ManyRanks ranks(kind, counts);
    kind == RankCounts::sum ? ranks.expect_sums() : ranks.expect_each();
    EXPECT_LE(ranks.pass().longest, longest);
    EXPECT_LE(ranks.pass().most_bytes_in, most_bytes_in);
    testing::Test::RecordProperty(name, std::to_string(ranks.pass().longest) + " longest, " +
                                            std::to_string(ranks.pass().most_bytes_in) +
                                            " into a rank");
}

TEST(RankCounts, of_64000_ranks_for_those_next_to_them_take_short_messages) {
    expect_short("each", RankCounts::each, counts_for_neighbours(40), 1000, 8000);
}

TEST(RankCounts, of_4096_ranks_for_any_take_short_messages) {
    const Counts counts = scattered_counts(4096, 50);
    expect_short("sum", RankCounts::sum, counts, 2000, 16000);
    expect_short("each", RankCounts::each, counts, 2000, 16000);
}

}  // namespace
}  // namespace rrcb
