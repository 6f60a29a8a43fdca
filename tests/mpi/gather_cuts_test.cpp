#include "../support/same_error.hpp"
#include "partial_trees.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/error.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rrcb {
namespace {

using test::known_here;
using test::num_ranks;
using test::random_cuts;
using test::rank;

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
            expect_same(gather_cuts(known_here(whole), MPI_COMM_WORLD), whole);
            expect_same(gather_cuts(known_here(whole, {rank() % num_parts}), MPI_COMM_WORLD),
                        whole);
            expect_same(gather_cuts(whole, MPI_COMM_WORLD), whole);
        }
    expect_same(gather_cuts({2, 1, {}}, MPI_COMM_WORLD), {2, 1, {}});
}

/// Expects an Error with this text on every rank, after which the next call works.
void expect_refusal(const std::string& text, const Cuts& cuts) {
    test::expect_same_error([&] { gather_cuts(cuts, MPI_COMM_WORLD); }, text);
    const Cuts whole = random_cuts(2, 9);
    expect_same(gather_cuts(known_here(whole), MPI_COMM_WORLD), whole);
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
    expect_refusal(last + "a cut has an axis", spoiled([](Cuts& cuts) { cuts.tree[0].axis = 2; }));
    if (num_ranks() == 1) return;
    expect_refusal("the dimension of the cuts differs",
                   spoiled([](Cuts& cuts) { cuts.dimension = 3; }));
    expect_refusal("whether the tree is whole differs", spoiled([&](Cuts& cuts) { cuts = whole; }));
}

TEST(WholeCuts, that_are_no_tree_or_differ_are_refused_on_all_ranks) {
    for (const int dimension : {-1, 0, 4, 9})
        expect_refusal("cuts must have 1, 2 or 3 dimensions", {dimension, 1, {}});
    expect_refusal("the tree must hold", {2, 0, {}});
    expect_refusal("the tree must hold", {2, 5, {}});
    if (num_ranks() == 1) return;
    Cuts whole = random_cuts(2, 9);
    if (test::is_last_rank()) whole.tree[3].at.fill(7);
    expect_refusal("the tree of cuts differs between rank 0 and rank", whole);
}

}  // namespace
}  // namespace rrcb
