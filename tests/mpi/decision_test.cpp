// The message of rank 0 with its decision.
#include "../support/common.hpp"
#include "../support/ranks.hpp"
#include "estimate/decision_mpi.hpp"

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

/// Buffers for a call from earlier cuts of one part for each rank, with a decision on rank 0.
Decision made_on_rank_0(const Cuts& earlier, Answer answer) {
    Options options;
    options.num_parts = num_ranks();
    options.part_sizes.assign(static_cast<std::size_t>(num_ranks()), 1.0);
    Decision decision;
    decision.earlier = &earlier;
    make_buffers(decision, options, 2, true);
    if (rank() != 0) return decision;
    decision.verdict.answer = answer;
    decision.verdict.has_numbers = 1;
    decision.verdict.debt = 0.75;
    std::iota(decision.numbers.rbegin(), decision.numbers.rend(), 0);
    for (std::size_t k = 0; k < decision.cuts.tree.size(); ++k)
        decision.cuts.tree[k].at[0] = static_cast<double>(k);
    return decision;
}

TEST(Decision, tells_all_ranks_the_numbers_of_parts) {
    for (const Answer answer : {Answer::cuts, Answer::kept}) {
        const Cuts earlier{};
        Participant self{MPI_COMM_WORLD};
        Decision decision = made_on_rank_0(earlier, answer);
        broadcast(decision, self);
        EXPECT_EQ(decision.verdict.answer, answer);
        EXPECT_EQ(decision.verdict.debt, 0.75);
        ASSERT_EQ(std::ssize(decision.numbers), num_ranks());
        for (int end = 0; end < num_ranks(); ++end)
            EXPECT_EQ(decision.numbers[static_cast<std::size_t>(end)], num_ranks() - 1 - end);
        for (std::size_t k = 0; k < decision.cuts.tree.size(); ++k)
            EXPECT_EQ(decision.cuts.tree[k].at[0], static_cast<double>(k));
    }
}

}  // namespace
}  // namespace rrcb
