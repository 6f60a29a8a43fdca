// Compiled, with the program it drives, through the renaming header and linked with an archive.
#include "program.hpp"

#include <gtest/gtest.h>

extern "C" int zoltan_archive_calls(const char* function);

namespace rrcb::zoltan_test {
namespace {

TEST(StaticZoltan, sees_nothing_of_a_partition_by_rrcb) {
    const int partitions = zoltan_archive_calls("Zoltan_LB_Partition");
    const int inversions = zoltan_archive_calls("Zoltan_Invert_Lists");
    Program program;
    scatter_points(program, 100);
    ASSERT_EQ(program.set("LB_METHOD", "RRCB"), ZOLTAN_OK);
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    EXPECT_EQ(zoltan_archive_calls("Zoltan_LB_Partition"), partitions);
    EXPECT_EQ(zoltan_archive_calls("Zoltan_Invert_Lists"), inversions);
}

TEST(StaticZoltan, gets_the_partitions_of_its_own_methods) {
    const int partitions = zoltan_archive_calls("Zoltan_LB_Partition");
    Program program;
    scatter_points(program, 100);
    ASSERT_EQ(program.set("LB_METHOD", "RCB"), ZOLTAN_OK);
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    EXPECT_EQ(zoltan_archive_calls("Zoltan_LB_Partition"), partitions + 1);
}

TEST(StaticZoltan, balances_with_rrcb_as_with_its_own_rcb) {
    double reached[2];
    const char* methods[] = {"RCB", "RRCB"};
    for (int i = 0; i < 2; ++i) {
        Program program;
        scatter_points(program, 500);
        program.set("LB_METHOD", methods[i]);
        program.set("OBJ_WEIGHT_DIM", "1");
        program.set("RETURN_LISTS", "PARTS");
        reached[i] = imbalance(program, program.partition(), program.num_ranks);
    }
    EXPECT_LT(reached[1], reached[0] + 0.01);
}

TEST(StaticZoltan, is_known_to_stand_behind_the_plug_in_where_calls_are_renamed) {
    EXPECT_EQ(RRCB_Zoltan_Active(), 1);
#undef RRCB_Zoltan_Active
    EXPECT_EQ(RRCB_Zoltan_Active(), 0);
}

}  // namespace
}  // namespace rrcb::zoltan_test
