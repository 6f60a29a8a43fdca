// Counts between ranks, against a number for each pair of them.
#include "../support/common.hpp"
#include "../support/ranks.hpp"
#include "collective/agreement_mpi.hpp"
#include "collective/duplicate.hpp"
#include "collective/rank_counts_mpi.hpp"

#include <rrcb/error.hpp>

namespace rrcb {
namespace {

/// Of counts that are a LocalIndex.
constexpr int shifts = std::numeric_limits<LocalIndex>::digits - 24;

/// For some of the ranks, this one among them; in every third round from none of the odd ones.
std::vector<std::uint64_t> counts_in(int round) {
    std::vector<std::uint64_t> counts(static_cast<std::size_t>(num_ranks()));
    if (round % 3 == 2 && rank() % 2 == 1) return counts;
    for (int to = 0; to < num_ranks(); ++to)
        if ((to + 2 * rank() + round) % 3 != 0)
            counts[static_cast<std::size_t>(to)] =
                static_cast<std::uint64_t>(1 + to + 1000 * rank() + round) << (round % shifts);
    return counts;
}

std::vector<RankCount> sparse(const std::vector<std::uint64_t>& counts) {
    std::vector<RankCount> result;
    for (int k = 0; k < num_ranks(); ++k)
        if (const auto count = counts[static_cast<std::size_t>(k)]; count > 0)
            result.push_back({k, count});
    return result;
}

TEST(RankCounts, are_those_of_each_pair_call_after_call) {
    Participant self{mpi::enter(MPI_COMM_WORLD, CallName::none).comm};
    for (int round = 0; round < 60; ++round) {
        const std::vector<std::uint64_t> to = counts_in(round);
        std::vector<std::uint64_t> from(to.size());
        const std::vector<RankCount> each = exchange_counts(sparse(to), self);
        MPI_Alltoall(to.data(), 1, MPI_UINT64_T, from.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
        const std::vector<RankCount> expected = sparse(from);
        ASSERT_EQ(each.size(), expected.size());
        for (std::size_t k = 0; k < each.size(); ++k) {
            EXPECT_EQ(each[k].rank, expected[k].rank);
            EXPECT_EQ(each[k].count, expected[k].count);
        }
    }
    EXPECT_FALSE(self.failed());
}

TEST(RankCounts, of_a_rank_that_failed_before_are_not_awaited) {
    for (int failing = 0; failing < num_ranks(); ++failing) {
        Participant self{mpi::enter(MPI_COMM_WORLD, CallName::none).comm};
        if (rank() == failing) self.failure = failure_of(ErrorCode::internal, "broken");
        try {
            exchange_counts({}, self);
            ADD_FAILURE() << "nothing was thrown";
        } catch (const Error& error) {
            EXPECT_EQ(error.what(), "rank " + std::to_string(failing) + ": broken");
        }
    }
}

TEST(RankCounts, that_contradict_a_plan_are_told_of_where_nothing_else_failed) {
    const auto expect = [](Participant& self, const std::string& text) {
        try {
            agree(self);
            ADD_FAILURE() << "nothing was thrown";
        } catch (const Error& error) {
            EXPECT_EQ(error.what(), text);
        }
    };
    const std::string last = std::to_string(num_ranks() - 1);
    for (const bool only : {true, false}) {
        Participant self{mpi::enter(MPI_COMM_WORLD, CallName::none).comm};
        if (!only && is_last_rank())
            self.attempt([] { throw Error(ErrorCode::internal, "broken"); });
        self.compare([] { throw Error(ErrorCode::invalid_argument, "other counts"); });
        expect(self, only ? "rank 0: other counts" : "rank " + last + ": broken");
    }
}

}  // namespace
}  // namespace rrcb
