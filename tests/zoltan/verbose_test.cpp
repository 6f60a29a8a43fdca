#include "program.hpp"

#include <gtest/gtest.h>

namespace rrcb::zoltan_test {
namespace {

/// What a partition prints on stdout on this rank.
std::string output_of(Program& program, const char* debug_level) {
    program.set("DEBUG_LEVEL", debug_level);
    testing::internal::CaptureStdout();
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    return testing::internal::GetCapturedStdout();
}

TEST(FirstCall, is_announced_once_when_debug_level_is_at_least_1) {
    Scattered program(100, {{"LB_METHOD", "RRCB"}});
    EXPECT_EQ(output_of(program, "0"), "");
    const std::string line = output_of(program, "1");
    if (program.rank == 0) {
        const std::string objects = std::to_string(100 * program.num_ranks) + " objects on " +
                                    std::to_string(program.num_ranks) + " ranks in " +
                                    std::to_string(program.num_ranks) + " parts";
        EXPECT_EQ(line.find("RRCB "), 0U) << line;
        EXPECT_NE(line.find(objects), line.npos) << line;
        EXPECT_EQ(line.find('\n') + 1, line.size()) << line;
    } else {
        EXPECT_EQ(line, "");
    }
    EXPECT_EQ(output_of(program, "1"), "");
}

}  // namespace
}  // namespace rrcb::zoltan_test
