#include "collective/merge_tree.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rrcb {
namespace {

std::vector<int> children_of(const MergeTree& tree, int rank) {
    std::vector<int> children;
    tree.for_each_child(rank, [&](int child) { children.push_back(child); });
    return children;
}

TEST(MergeTree, is_a_star_up_to_its_radix) {
    const MergeTree tree{8, 8};
    EXPECT_EQ(children_of(tree, 0), (std::vector<int>{1, 2, 3, 4, 5, 6, 7}));
    EXPECT_TRUE(children_of(tree, 3).empty());
    EXPECT_EQ(tree.parent(7), 0);
}

TEST(MergeTree, of_radix_two_is_the_binomial_tree) {
    const MergeTree tree{7, 2};
    EXPECT_EQ(children_of(tree, 0), (std::vector<int>{1, 2, 4}));
    EXPECT_EQ(children_of(tree, 4), (std::vector<int>{5, 6}));
    EXPECT_EQ(tree.parent(6), 4);
    EXPECT_EQ(tree.parent(5), 4);
}

TEST(MergeTree, hangs_every_rank_on_one_parent_and_takes_them_in_by_number) {
    for (const int radix : {2, 3, 8}) {
        for (const int num_ranks : {1, 2, 3, 8, 9, 64, 65, 1000}) {
            const MergeTree tree{num_ranks, radix};
            std::vector<int> parents(static_cast<std::size_t>(num_ranks), -1);
            for (int rank = 0; rank < num_ranks; ++rank) {
                int last = rank;
                for (const int child : children_of(tree, rank)) {
                    EXPECT_GT(child, last);
                    EXPECT_EQ(parents[static_cast<std::size_t>(child)], -1);
                    EXPECT_EQ(tree.parent(child), rank);
                    parents[static_cast<std::size_t>(child)] = rank;
                    last = child;
                }
            }
            for (int rank = 1; rank < num_ranks; ++rank)
                EXPECT_GE(parents[static_cast<std::size_t>(rank)], 0) << rank;
        }
    }
}

TEST(MergeTree, of_a_million_ranks_is_seven_levels_deep) {
    const MergeTree tree{1 << 20, 8};
    EXPECT_EQ(children_of(tree, 0).size(), 6 * 7u + 3u);  // 8^6 * 4 ranks
    EXPECT_EQ(tree.parent((1 << 20) - 1), (1 << 20) - 8);
}

}  // namespace
}  // namespace rrcb
