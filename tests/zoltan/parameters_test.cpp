#include "program.hpp"

#include <rrcb/zoltan/rrcb_zoltan.h>

namespace rrcb::zoltan_test {
namespace {

TEST(PlugIn, says_that_it_stands_in_front_and_the_version_of_the_build) {
    EXPECT_EQ(RRCB_Zoltan_Active(), 1);
    EXPECT_STREQ(RRCB_Version(), RRCB_EXPECTED_VERSION);
}

TEST(Parameters, of_rrcb_are_accepted_in_any_case_with_leading_blanks) {
    Program program;
    EXPECT_EQ(program.set("LB_METHOD", "RRCB"), ZOLTAN_OK);
    EXPECT_EQ(program.set("lb_method", "rrcb"), ZOLTAN_OK);
    EXPECT_EQ(program.set(" Lb_Method", " Rrcb"), ZOLTAN_OK);
    for (const char* value : {"AUTO", "auto", "1", "8", "64", "DEFAULT"}) {
        EXPECT_EQ(program.set("RRCB_SUPPORT_MESH", value), ZOLTAN_OK) << value;
    }
    for (const char* value : {"ANALYTIC", "sampled", "Points", "DEFAULT"}) {
        EXPECT_EQ(program.set("rrcb_domain", value), ZOLTAN_OK) << value;
    }
    EXPECT_EQ(program.set("RRCB_CUT_RULE", "MIDPOINT"), ZOLTAN_OK);
    EXPECT_EQ(program.set("RRCB_CUT_RULE", "WEIGHTED"), ZOLTAN_OK);
    EXPECT_EQ(program.set("RRCB_SIGMA_MULTIPLIER", "1.25"), ZOLTAN_OK);
    EXPECT_EQ(program.set("RRCB_SAMPLE_FRACTION", "0.125"), ZOLTAN_OK);
    EXPECT_EQ(program.set("RRCB_SEED", "18446744073709551615"), ZOLTAN_OK);
}

TEST(Parameters, with_illegal_values_or_unknown_names_warn_as_zoltan_does) {
    Program program;
    EXPECT_EQ(program.set("IMBALANCE_TOL", "NONSENSE"), ZOLTAN_WARN);  // Zoltan's own
    EXPECT_EQ(program.set("RRCB_NONSENSE", "1"), ZOLTAN_WARN);
    for (const char* value : {"-2", "-1", "8X", "", "1.5", "99999999999"}) {
        EXPECT_EQ(program.set("RRCB_SUPPORT_MESH", value), ZOLTAN_WARN) << value;
    }
    for (const char* value : {"LEARNED", "SAMPLE", "", "1"}) {
        EXPECT_EQ(program.set("RRCB_DOMAIN", value), ZOLTAN_WARN) << value;
    }
    EXPECT_EQ(program.set("RRCB_REFINE", "AUTO"), ZOLTAN_WARN);
    EXPECT_EQ(program.set("RRCB_CUT_RULE", "HALF"), ZOLTAN_WARN);
    for (const char* value : {"0", "-2", "NAN", "INF", "TWO"}) {
        EXPECT_EQ(program.set("RRCB_SIGMA_MULTIPLIER", value), ZOLTAN_WARN) << value;
    }
    for (const char* value : {"0", "1.01", "-0.5", "HALF"}) {
        EXPECT_EQ(program.set("RRCB_SAMPLE_FRACTION", value), ZOLTAN_WARN) << value;
    }
    EXPECT_EQ(program.set("RRCB_SEED", "-1"), ZOLTAN_WARN);
}

std::vector<int> parts_with(Program& program, const char* name, const char* value) {
    EXPECT_GE(program.set(name, value), ZOLTAN_OK);
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK) << name << "=" << value;
    return outcome.exports.parts;
}

// That each reaches the balancer is a test of the environment.
TEST(Parameters, stay_after_an_illegal_value_and_have_a_default) {
    Scattered program(3000);
    for (double& x : program.coordinates) x *= x;
    program.set({{"RETURN_LISTS", "PARTS"}, {"NUM_GLOBAL_PARTS", "6"}});
    program.set({{"LB_METHOD", "RRCB"}, {"RRCB_REFINE", "NONE"}});
    for (const auto& [domain, name, value] : {std::tuple{"ANALYTIC", "RRCB_SUPPORT_MESH", "2"},
                                              {"POINTS", "RRCB_CUT_RULE", "MIDPOINT"},
                                              {"SAMPLED", "RRCB_SIGMA_MULTIPLIER", "0.5"},
                                              {"SAMPLED", "RRCB_SEED", "7"},
                                              {"SAMPLED", "RRCB_SAMPLE_FRACTION", "0.25"}}) {
        const auto defaults = parts_with(program, "RRCB_DOMAIN", domain);
        const auto other = parts_with(program, name, value);
        EXPECT_TRUE(differ_somewhere(other, defaults)) << name;
        EXPECT_FALSE(differ_somewhere(parts_with(program, name, "NONSENSE"), other)) << name;
        EXPECT_FALSE(differ_somewhere(parts_with(program, name, "DEFAULT"), defaults)) << name;
    }
}

TEST(Parameters, end_before_the_blanks_behind_them) {
    // Blanks behind a value belong to none; Zoltan takes numbers so, and words not at all.
    const auto parts_at = [](const char* tolerance, const char* mesh) {
        Scattered program(3000);
        for (double& x : program.coordinates) x *= x;
        program.set({{"RETURN_LISTS", "PARTS"}, {"NUM_GLOBAL_PARTS", "6"}});
        EXPECT_EQ(program.set("LB_METHOD", "RRCB "), ZOLTAN_OK);
        EXPECT_EQ(program.set("RRCB_SUPPORT_MESH", mesh), ZOLTAN_OK);
        EXPECT_EQ(program.set("RRCB_REFINE", "TOLERANCE \t"), ZOLTAN_OK);
        EXPECT_EQ(program.set("RRCB_SEED", "DEFAULT "), ZOLTAN_OK);
        EXPECT_EQ(program.set("IMBALANCE_TOL", tolerance), ZOLTAN_OK);
        return program.partition().exports.parts;
    };
    const auto expected = parts_at("1.5", "2");
    EXPECT_TRUE(differ_somewhere(expected, parts_at("1.01", "2")));
    EXPECT_EQ(parts_at("1.5 ", "2 "), expected);
    EXPECT_EQ(parts_at("+1.5", "2"), expected);
    EXPECT_EQ(parts_at("1.5x", "2"), expected);
}

TEST(Parameters, an_unknown_method_is_fatal_and_keeps_the_old_one) {
    Scattered program(100);
    program.set({{"LB_METHOD", "RRCB"}, {"RRCB_DOMAIN", "SAMPLED"}, {"RETURN_LISTS", "PARTS"}});
    const auto before = program.partition().exports.parts;
    EXPECT_EQ(program.set("LB_METHOD", "NO_SUCH_METHOD"), ZOLTAN_FATAL);
    EXPECT_EQ(program.partition().exports.parts, before);
}

TEST(Parameters, out_of_range_fall_back_to_the_default_as_in_zoltan) {
    for (const char* method : {"RCB", "RRCB"}) {
        SCOPED_TRACE(method);
        Scattered program(100, {{"LB_METHOD", method}});
        Zoltan_Set_Param(program.zz, "NUM_GID_ENTRIES", "0");
        Zoltan_Set_Param(program.zz, "NUM_LID_ENTRIES", "-3");
        Zoltan_Set_Param(program.zz, "RETURN_LISTS", "NO_SUCH_LIST");
        Zoltan_Set_Param(program.zz, "OBJ_WEIGHT_DIM", "-1");
        const Outcome outcome = program.partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        EXPECT_EQ(outcome.num_gid, 1);
        EXPECT_EQ(outcome.num_lid, 1);
        EXPECT_GE(outcome.imports.count, 0);
        EXPECT_GE(outcome.exports.count, 0);
    }
}

/// Whether each list was asked for, and whether the exports are all objects.
std::array<bool, 3> shape_of(const Program& program, const Outcome& outcome) {
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_EQ(outcome.changes, 1);
    return {outcome.imports.count >= 0, outcome.exports.count >= 0,
            outcome.exports.count == program.size()};
}

TEST(Parameters, for_lists_may_differ_between_ranks_as_in_zoltan) {
    constexpr std::array words = {"ALL", "PARTS", "EXPORT", "IMPORT", "NONE"};
    for (const char* first : words) {
        for (const char* others : words) {
            SCOPED_TRACE(std::string(first) + ", " + others);
            std::array<std::array<bool, 3>, 2> shapes{};
            for (const bool ours : {false, true}) {
                Program program;
                if (program.num_ranks == 1) GTEST_SKIP() << "needs two ranks";
                scatter_points(program, 100);
                program.set("LB_METHOD", ours ? "RRCB" : "RCB");
                program.set("RETURN_LISTS", program.rank == 0 ? first : others);
                shapes[ours ? 1 : 0] = shape_of(program, program.partition());
                EXPECT_EQ(shape_of(program, program.partition()), shapes[ours ? 1 : 0]);
            }
            EXPECT_EQ(shapes[0], shapes[1]);
        }
    }
}

/// All ranks fail; rank 0 names the parameter.
void expect_difference(const std::string& name, const char* value) {
    SCOPED_TRACE(name);
    Scattered program(50, {{"LB_METHOD", "RRCB"}, {"OBJ_WEIGHT_DIM", "1"}});
    // By the method that takes the parameter.
    const bool is_of_paper = name == "RRCB_CUT_RULE" || name == "RRCB_SIGMA_MULTIPLIER" ||
                             name == "RRCB_SAMPLE_FRACTION" || name == "RRCB_SEED";
    if (is_of_paper) program.set("RRCB_DOMAIN", "SAMPLED");
    if (program.rank == program.num_ranks - 1) program.set(name.c_str(), value);
    testing::internal::CaptureStderr();
    const Outcome outcome = program.partition();
    const std::string printed = testing::internal::GetCapturedStderr();
    EXPECT_EQ(outcome.code, ZOLTAN_FATAL);
    EXPECT_EQ(outcome.exports.count, 0);
    const bool names_it = printed.find(name + " differs between ranks") != printed.npos;
    EXPECT_EQ(names_it, program.rank == 0) << printed;
}

TEST(Parameters, that_differ_between_ranks_are_named_and_fatal_everywhere) {
    if (Program().num_ranks == 1) GTEST_SKIP() << "needs two ranks";
    constexpr std::pair<const char*, const char*> others[] = {{"NUM_GID_ENTRIES", "2"},
                                                              {"NUM_LID_ENTRIES", "2"},
                                                              {"OBJ_WEIGHT_DIM", "0"},
                                                              {"AUTO_MIGRATE", "1"},
                                                              {"REMAP", "0"},
                                                              {"RCB_REUSE", "1"},
                                                              {"RCB_LOCK_DIRECTIONS", "1"},
                                                              {"RCB_SET_DIRECTIONS", "3"},
                                                              {"RCB_RECTILINEAR_BLOCKS", "1"},
                                                              {"IMBALANCE_TOL", "1.3"},
                                                              {"RRCB_DOMAIN", "SAMPLED"},
                                                              {"RRCB_REFINE", "EXACT"},
                                                              {"RRCB_COINCIDENT", "TOGETHER"},
                                                              {"RRCB_CUT_RULE", "MIDPOINT"},
                                                              {"RRCB_SUPPORT_MESH", "9"},
                                                              {"RRCB_SIGMA_MULTIPLIER", "2"},
                                                              {"RRCB_SAMPLE_FRACTION", "0.5"},
                                                              {"RRCB_SEED", "5"}};
    for (const auto& [name, value] : others) expect_difference(name, value);
}

}  // namespace
}  // namespace rrcb::zoltan_test
