#include "program.hpp"
#include "regions.hpp"

#include <gtest/gtest.h>

#include <array>
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

constexpr int num_regions = 5;

std::vector<std::array<double, 3>> faces_of_regions(const Program& program) {
    std::vector<std::array<double, 3>> faces;
    for (int part = 0; part < num_regions; ++part) {
        const Region region = region_of(program.zz, part);
        EXPECT_EQ(region.code, ZOLTAN_OK);
        faces.push_back(region.lower);
        faces.push_back(region.upper);
    }
    return faces;
}

TEST(Replacement, leaves_cuts_within_the_tolerance_unless_told_not_to) {
    Program program;
    scatter_points(program, 2000);
    program.set("KEEP_CUTS", "1");
    program.set("IMBALANCE_TOL", "1.1");
    program.set("REMAP", "0");
    program.set("NUM_GLOBAL_PARTS", std::to_string(num_regions));
    const auto faces_after_a_move = [&] {
        for (double& x : program.coordinates) x += 1e-3 * x;
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
        return faces_of_regions(program);
    };
    const auto first = faces_after_a_move();
    EXPECT_EQ(faces_after_a_move(), first);
    program.set("RCB_SET_DIRECTIONS", "1");
    const auto with_other_axes = faces_after_a_move();
    EXPECT_NE(with_other_axes, first);
    EXPECT_EQ(faces_after_a_move(), with_other_axes);
    program.set("RCB_REUSE", "0");
    const auto cold = faces_after_a_move();
    EXPECT_NE(faces_after_a_move(), cold);
    program.set("RCB_REUSE", "DEFAULT");
    const auto again = faces_after_a_move();
    EXPECT_EQ(faces_after_a_move(), again);
}

TEST(Replacement, gives_no_look_ups_without_keep_cuts) {
    Program program;
    scatter_points(program, 200);
    for (int call = 0; call < 2; ++call) {
        program.partition();
        std::array<double, 2> x = {0.5, 0.5};
        int rank = 17, part = 17;
        EXPECT_EQ(Zoltan_LB_Point_PP_Assign(program.zz, x.data(), &rank, &part), ZOLTAN_FATAL);
        EXPECT_EQ(rank, -1);
        EXPECT_EQ(part, -1);
    }
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
