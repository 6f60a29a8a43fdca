#include "estimate/keeping_mpi.hpp"

#include <gtest/gtest.h>

#include <limits>

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
    EXPECT_FALSE(reads_kept_tree(to(1.01, Refine::exact), 4));
    EXPECT_FALSE(reads_kept_tree(to(1.01), 3));
    Options many = to(1.01);
    many.num_parts = 4096;
    EXPECT_TRUE(reads_kept_tree(many, 4096));
    many.num_parts = 4097;
    EXPECT_FALSE(reads_kept_tree(many, 4097));
}

TEST(KeptTree, stay_at_once_within_a_tenth_of_the_tolerance) {
    EXPECT_TRUE(keeps_at_once(1.0009, 1.01));
    EXPECT_FALSE(keeps_at_once(1.0011, 1.01));
    EXPECT_TRUE(keeps_at_once(1, 1));
    EXPECT_FALSE(keeps_at_once(1 + 1e-9, 1));
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
    EXPECT_TRUE(keeps_at_once(3, endless));
}

}  // namespace
}  // namespace rrcb
