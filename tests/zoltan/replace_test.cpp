#include "program.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

// Runs with RRCB_REPLACE=RCB in the environment, which CTest sets.
namespace rrcb::zoltan_test {
namespace {

struct TenParts : Program {
    TenParts() {
        scatter_points(*this, 500);
        set("RETURN_LISTS", "PARTS");
        set("NUM_GLOBAL_PARTS", "10");
        // RCB knows nothing of this one: it tells who partitions.
        set("RRCB_CUT_RULE", "MIDPOINT");
        set("RRCB_REFINE", "NONE");
    }
    std::vector<int> parts() { return parts_by_object(partition()); }
};

std::vector<int> parts_of_method(const char* method) {
    TenParts program;
    EXPECT_EQ(program.set("LB_METHOD", method), ZOLTAN_OK);
    return program.parts();
}

TEST(Replacement, is_asked_for) {
    ASSERT_STREQ(std::getenv("RRCB_REPLACE"), "RCB");
}

TEST(Replacement, answers_rcb_and_the_default_with_rrcb) {
    const std::vector<int> rrcb = parts_of_method("RRCB");
    EXPECT_EQ(parts_of_method("RCB"), rrcb);
    EXPECT_EQ(parts_of_method("rcb"), rrcb);
    EXPECT_EQ(TenParts().parts(), rrcb);
}

TEST(Replacement, leaves_other_methods_alone_and_returns_to_rcb) {
    TenParts program;
    const std::vector<int> rrcb = program.parts();
    EXPECT_EQ(program.set("LB_METHOD", "RIB"), ZOLTAN_OK);
    EXPECT_NE(program.parts(), rrcb);
    EXPECT_EQ(program.set("LB_METHOD", "RCB"), ZOLTAN_OK);
    EXPECT_EQ(program.parts(), rrcb);
    EXPECT_EQ(program.set("LB_METHOD", "NO_SUCH_METHOD"), ZOLTAN_FATAL);
    EXPECT_EQ(program.parts(), rrcb);
}

TEST(Replacement, holds_for_copies_and_look_ups) {
    TenParts program;
    program.set("KEEP_CUTS", "1");
    const std::vector<int> parts = program.parts();
    Zoltan_Struct* copy = Zoltan_Copy(program.zz);
    for (int i = 0; i < program.size(); ++i) {
        int rank = -1, part = -1;
        double* position = &program.coordinates[static_cast<std::size_t>(2 * i)];
        EXPECT_EQ(Zoltan_LB_Point_PP_Assign(copy, position, &rank, &part), ZOLTAN_OK);
        EXPECT_EQ(part, parts[static_cast<std::size_t>(i)]);
    }
    Zoltan_Destroy(&copy);
}

TEST(Replacement, lets_zoltan_evaluate) {
    TenParts program;
    const std::vector<int> before = program.parts();
    ZOLTAN_BALANCE_EVAL evaluation;
    EXPECT_EQ(Zoltan_LB_Eval(program.zz, 0, &evaluation, nullptr, nullptr), ZOLTAN_OK);
    EXPECT_EQ(evaluation.nobj[EVAL_GLOBAL_SUM], 500.0F * static_cast<float>(program.num_ranks));
    EXPECT_EQ(program.parts(), before);
}

TEST(Replacement, leaves_the_handles_that_zoltan_makes_for_itself) {
    Program program;
    scatter_points(program, 300);
    use_hier(program, "RCB");
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_EQ(outcome.exports.count > 0, program.num_ranks > 1);
}

}  // namespace
}  // namespace rrcb::zoltan_test
