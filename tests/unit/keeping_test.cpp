#include "estimate/keeping_mpi.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace rrcb {
namespace {

Options to(double tolerance, Refine refine = Refine::tolerance) {
    Options options;
    options.imbalance_tolerance = tolerance;
    options.refine = refine;
    options.num_parts = 4;
    return options;
}

TEST(KeptTree, are_read_up_to_a_number_of_ranks_where_each_has_a_part_to_be_estimated) {
    EXPECT_TRUE(reads_kept_tree(to(1.01), 4));
    EXPECT_TRUE(reads_kept_tree(to(1.01, Refine::none), 4));
    EXPECT_TRUE(reads_kept_tree(to(1.01, Refine::exact), 4));
    EXPECT_FALSE(reads_kept_tree(to(1.01), 3));
    Options many = to(1.01);
    many.num_parts = 4096;
    EXPECT_TRUE(reads_kept_tree(many, 4096));
    many.num_parts = 4097;
    EXPECT_FALSE(reads_kept_tree(many, 4097));
}

TEST(KeptTree, stay_at_once_within_a_tenth_of_the_tolerance) {
    EXPECT_TRUE(keeps_at_once(1.0009, to(1.01)));
    EXPECT_FALSE(keeps_at_once(1.0011, to(1.01)));
    EXPECT_TRUE(keeps_at_once(1, to(1)));
    EXPECT_FALSE(keeps_at_once(1 + 1e-9, to(1)));
    EXPECT_FALSE(keeps_at_once(1, to(1.01, Refine::exact))) << "exact cuts are searched";
}

/// Whether four parts of equal size, with these weights, stay though exact cuts would give others.
/// The first cut may divide coincident points of weight 2.
bool stay(const std::vector<double>& kept, const std::vector<double>& found, bool divides = false) {
    Options options = to(1.01, Refine::exact);
    options.part_sizes.assign(4, 1);
    Cuts cuts{1, 4, std::vector<Cut>(3)};
    cuts.tree[0].divides = divides ? 1 : 0;
    return are_as_exact(kept, found, cuts, 2, options);
}

TEST(ExactParts, stay_if_each_cut_is_as_near_to_its_share) {
    EXPECT_TRUE(stay({10, 11, 10, 10}, {10, 11, 10, 10}));
    EXPECT_FALSE(stay({11, 10, 10, 10}, {10, 10, 10, 11})) << "the odd point is above";
    EXPECT_TRUE(stay({10, 11, 10, 10}, {10, 11 * (1 + 1e-13), 10, 10})) << "round-off";
    EXPECT_FALSE(stay({10, 11, 10, 10}, {10, 11 * (1 - 1e-9), 10, 10})) << "a gain";
    EXPECT_FALSE(stay({100, 0, 99, 1}, {100, 0, 50, 50})) << "below another cut, of no effect";
    EXPECT_FALSE(stay({2, 0, 1, 1}, {1, 1, 1, 1})) << "empty";
    EXPECT_FALSE(stay({11, 11, 10, 10}, {11, 10, 10, 11}));
    EXPECT_TRUE(stay({11, 11, 10, 10}, {11, 10, 10, 11}, true)) << "by the order of the points";
    EXPECT_FALSE(stay({12, 11, 10, 10}, {11, 11, 10, 11}, true)) << "more even";
    EXPECT_TRUE(stay({1e-30, 1, 1e-20, 1}, {1e-30, 1, 1e-20, 1}));
}

TEST(Move, from_above_the_tolerance_to_within_it_is_worth_it) {
    for (const Refine refine : {Refine::none, Refine::tolerance}) {
        EXPECT_TRUE(is_worth_moving(1.0101, 1.01, to(1.01, refine)));
        EXPECT_FALSE(is_worth_moving(1.01, 1.0101, to(1.01, refine)));
    }
}

TEST(Move, within_the_tolerance_is_worth_it_where_the_excess_halves_and_much_is_gained) {
    EXPECT_TRUE(is_worth_moving(1.008, 1.004, to(1.01)));
    EXPECT_FALSE(is_worth_moving(1.008, 1.0041, to(1.01)));
    EXPECT_FALSE(is_worth_moving(1.02, 1.01, to(1.5)));
}

TEST(Move, above_the_tolerance_is_worth_what_a_search_gains_or_half_the_excess_of_an_estimate) {
    EXPECT_TRUE(is_worth_moving(1.3, 1.2, to(1.01)));
    EXPECT_FALSE(is_worth_moving(1.3, 1.2, to(1.01, Refine::none)));
    EXPECT_TRUE(is_worth_moving(1.3, 1.15, to(1.01, Refine::none)));
    EXPECT_FALSE(is_worth_moving(1.3, 1.2999, to(1.01)));
    EXPECT_FALSE(is_worth_moving(1.3, 1.3, to(1)));
    EXPECT_FALSE(is_worth_moving(1.3, 1.4, to(1.01)));
}

TEST(Move, of_an_endless_tolerance_is_never_worth_it) {
    const double endless = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(is_worth_moving(3, 1, to(endless)));
    EXPECT_TRUE(keeps_at_once(3, to(endless)));
}

}  // namespace
}  // namespace rrcb
