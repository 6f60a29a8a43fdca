#include "program.hpp"

#include <gtest/gtest.h>

namespace rrcb::zoltan_test {
namespace {

/// What is legal, but not as good as it was asked for; what RRCB says of it on rank 0, if anything.
struct Case {
    const char* name;
    void (*prepare)(Program&);
    const char* words = "";
};

constexpr Case cases[] = {
    {"more parts than objects",
     [](Program& p) {
         if (p.rank == 0) p.add({0, 0}), p.add({1, 1});
         p.set("NUM_GLOBAL_PARTS", "5");
     },
     "3 parts stay empty"},
    {"weights that are all zero",
     [](Program& p) {
         scatter_points(p, 50);
         p.weights.assign(50, 0);
         p.set("OBJ_WEIGHT_DIM", "1");
     },
     "all weights are zero"},
    {"an object that outweighs the others",
     [](Program& p) {
         scatter_points(p, 50);
         if (p.rank == 0) p.weights[3] = 1e6F;
         p.set({{"OBJ_WEIGHT_DIM", "1"}, {"NUM_GLOBAL_PARTS", "3"}});
     },
     "one object outweighs a part"},
    {"objects in one place",
     [](Program& p) {
         for (int i = 0; i < 50; ++i) p.add({1, 2});
     }},
    {"one object alone",
     [](Program& p) {
         if (p.rank == 0) p.add({1, 2});
     }},
    {"an order of axes that is none",
     [](Program& p) {
         scatter_points(p, 50);
         p.set("RCB_SET_DIRECTIONS", "7");
     },
     "RCB_SET_DIRECTIONS out of bounds"},
};

int code_of(const Case& given, const char* method, std::string& said) {
    Program program;
    given.prepare(program);
    program.set({{"LB_METHOD", method}, {"DEBUG_LEVEL", "1"}});
    testing::internal::CaptureStderr();
    const int code = program.partition().code;
    said = testing::internal::GetCapturedStderr();
    return code;
}

TEST(Codes, are_those_of_zoltan_and_warnings_are_printed_once) {
    const int rank = Program().rank;
    for (const Case& given : cases) {
        SCOPED_TRACE(given.name);
        std::string zoltans, ours;
        EXPECT_EQ(code_of(given, "RCB", zoltans), ZOLTAN_OK);
        EXPECT_EQ(code_of(given, "RRCB", ours), ZOLTAN_OK);
        if (rank == 0) {
            EXPECT_NE(ours.find(given.words), ours.npos) << ours;
        } else {
            EXPECT_EQ(ours, "");
        }
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
