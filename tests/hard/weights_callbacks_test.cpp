#include "../zoltan/program.hpp"
#include "methods.hpp"

#include <gtest/gtest.h>

namespace rrcb::hard_test {
namespace {

using zoltan_test::Program;

std::string warnings_of(Program& program, const char* method) {
    program.set({{"LB_METHOD", "RRCB"}, {"DEBUG_LEVEL", "1"}, {"RRCB_REFINE", method}});
    program.set({{"OBJ_WEIGHT_DIM", "1"}, {"NUM_GLOBAL_PARTS", "4"}});
    testing::internal::CaptureStderr();
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    return testing::internal::GetCapturedStderr();
}

bool holds(const std::string& text, const std::string& words) {
    return text.find(words) != text.npos;
}

TEST(CallbackWeights, heavier_than_a_part_and_coincident_objects_are_warned_of) {
    for (const char* method : {"TOLERANCE", "EXACT"}) {
        Program heavy;
        scatter_points(heavy, 100);
        heavy.weights.assign(100, 1);
        EXPECT_EQ(warnings_of(heavy, method), "");
        if (heavy.rank == 0) heavy.weights[17] = 1e6F;
        EXPECT_EQ(holds(warnings_of(heavy, method), "one object outweighs a part"),
                  heavy.rank == 0);

        Program columns;
        for (int i = 0; i < 99; ++i) columns.add({double(i % 3), 0.001 * i});
        columns.set("RCB_RECTILINEAR_BLOCKS", "1");
        EXPECT_EQ(holds(warnings_of(columns, method), "cuts met objects in one plane"),
                  columns.rank == 0);

        Program coincident;
        for (int i = 0; i < 100; ++i) coincident.add({3, 4});
        EXPECT_EQ(warnings_of(coincident, method), "");
        coincident.set("RRCB_COINCIDENT", "TOGETHER");
        EXPECT_EQ(holds(warnings_of(coincident, method), "2 cuts met objects in one place"),
                  coincident.rank == 0);
    }
}

}  // namespace
}  // namespace rrcb::hard_test
