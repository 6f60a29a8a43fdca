#include "../support/clouds.hpp"
#include "../support/partial_cuts.hpp"
#include "../support/ranks.hpp"

#include <rrcb/error.hpp>
#include <rrcb/locate.hpp>
#include <rrcb/plan.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::num_ranks;
using test::rank;

/// The same tree on every rank, with zeros, infinities and both signs.
Cuts random_cuts(int dimension, int num_parts) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::mt19937_64 engine(static_cast<unsigned>(num_parts));
    Cuts cuts{dimension, num_parts, {}};
    for (int k = 1; k < num_parts; ++k) {
        Cut cut;
        cut.axis = static_cast<std::int32_t>(engine() % static_cast<unsigned>(dimension));
        cut.divides = static_cast<std::int32_t>(engine() % 2);
        for (double& x : cut.at)
            x = engine() % 4 == 0 ? -infinity : static_cast<double>(engine() % 9) - 4;
        cuts.tree.push_back(cut);
    }
    return cuts;
}

/// What a rank knows of it: the paths to its own parts, and to some others.
Cuts known_here(const Cuts& whole, std::vector<Part> also = {}) {
    for (Part part = 0; part < whole.num_parts; ++part) {
        const RankRange ranks = ranks_of_part(part, whole.num_parts, num_ranks());
        if (rank() >= ranks.first_rank && rank() < ranks.first_rank + ranks.count)
            also.push_back(part);
    }
    return test::cut_down(whole, also);
}

void expect_same(const Cuts& cuts, const Cuts& expected) {
    EXPECT_EQ(cuts.dimension, expected.dimension);
    EXPECT_EQ(cuts.num_parts, expected.num_parts);
    EXPECT_TRUE(is_whole(cuts));
    ASSERT_EQ(cuts.tree.size(), expected.tree.size());
    for (std::size_t k = 0; k < cuts.tree.size(); ++k) {
        EXPECT_EQ(cuts.tree[k].axis, expected.tree[k].axis);
        EXPECT_EQ(cuts.tree[k].divides, expected.tree[k].divides);
        EXPECT_EQ(cuts.tree[k].at, expected.tree[k].at);
    }
}

TEST(WholeCuts, are_those_that_each_rank_had_a_part_of) {
    for (const int dimension : {1, 2, 3})
        for (const int num_parts : {2, 3, num_ranks() + 1, 2 * num_ranks() + 1, 100}) {
            const Cuts whole = random_cuts(dimension, num_parts);
            expect_same(whole_cuts(known_here(whole), MPI_COMM_WORLD), whole);
            expect_same(whole_cuts(known_here(whole, {rank() % num_parts}), MPI_COMM_WORLD), whole);
            expect_same(whole_cuts(whole, MPI_COMM_WORLD), whole);
        }
    expect_same(whole_cuts({2, 1, {}}, MPI_COMM_WORLD), {2, 1, {}});
}

/// Expects an Error with this text on every rank, after which the next call works.
void expect_refusal(const std::string& text, const Cuts& cuts) {
    try {
        whole_cuts(cuts, MPI_COMM_WORLD);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
        EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
    const Cuts whole = random_cuts(2, 9);
    expect_same(whole_cuts(known_here(whole), MPI_COMM_WORLD), whole);
}

TEST(WholeCuts, that_no_balance_left_with_the_ranks_are_refused_on_all_of_them) {
    const Cuts whole = random_cuts(2, 2 * num_ranks() + 5);
    const Cuts right = known_here(whole);
    const auto spoiled = [&](auto&& spoil) {
        Cuts cuts = right;
        if (test::is_last_rank()) spoil(cuts);
        return cuts;
    };
    const std::string last = "rank " + std::to_string(num_ranks() - 1) + ": ";
    // The last rank owns the last node: its first part is the last but one.
    expect_refusal(last + "a cut is missing", spoiled([](Cuts& cuts) {
                       cuts.nodes.pop_back();
                       cuts.tree.pop_back();
                   }));
    expect_refusal(last + "the tree must hold", spoiled([](Cuts& cuts) { cuts.tree.pop_back(); }));
    expect_refusal(last + "the tree must hold",
                   spoiled([](Cuts& cuts) { cuts.nodes.back() = cuts.num_parts - 1; }));
    expect_refusal(last + "the tree must hold",
                   spoiled([](Cuts& cuts) { std::swap(cuts.nodes[0], cuts.nodes[1]); }));
    expect_refusal(last + "cuts must cross axes",
                   spoiled([](Cuts& cuts) { cuts.tree[0].axis = 2; }));
    if (num_ranks() == 1) return;
    expect_refusal("the dimension of the cuts differs",
                   spoiled([](Cuts& cuts) { cuts.dimension = 3; }));
    expect_refusal("whether the tree is whole differs", spoiled([&](Cuts& cuts) { cuts = whole; }));
}

}  // namespace
}  // namespace rrcb
