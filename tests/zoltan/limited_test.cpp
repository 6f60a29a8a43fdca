// RRCB_MIN_WIDTH and RRCB_GRID, which limit where cuts may lie.
#include "program.hpp"

namespace rrcb::zoltan_test {
namespace {

constexpr double open = std::numeric_limits<double>::max();

/// Points of the unit square, the denser the nearer to the corner.
struct Corner : Scattered {
    Corner() : Scattered(1000, {{"LB_METHOD", "RRCB"}, {"KEEP_CUTS", "1"}}) {
        for (double& x : coordinates) x = x * x * x;
        set("RETURN_LISTS", "PARTS");
    }
};

std::array<double, 6> box_of(Program& program, int part) {
    std::array<double, 6> box{};
    int num_axes = 0;
    EXPECT_EQ(Zoltan_RCB_Box(program.zz, part, &num_axes, &box[0], &box[1], &box[2], &box[3],
                             &box[4], &box[5]),
              ZOLTAN_OK);
    return box;
}

bool is_face(double value) {
    return std::abs(value) < open;
}

TEST(MinWidth, keeps_the_parts_wide) {
    double least_free = 1;
    double least = 1;
    for (const char* width : {"NONE", "0.2 0.15"}) {
        Corner program;
        program.set("NUM_GLOBAL_PARTS", "9");
        EXPECT_EQ(program.set("RRCB_MIN_WIDTH", width), ZOLTAN_OK);
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
        double& narrowest = width[0] == 'N' ? least_free : least;
        for (int part = 0; part < 9; ++part) {
            const auto box = box_of(program, part);
            for (std::size_t a = 0; a < 2; ++a)
                if (is_face(box[a + 3])) {
                    const double lower = is_face(box[a]) ? box[a] : 0;
                    narrowest = std::min(narrowest, (box[a + 3] - lower) / (a == 0 ? 0.2 : 0.15));
                }
        }
    }
    EXPECT_LT(least_free, 1);
    EXPECT_GE(least, 1 - 1e-12);
}

TEST(Grid, holds_the_cuts_that_average_cuts_would_move) {
    Corner program;
    program.set({{"NUM_GLOBAL_PARTS", "6"}, {"AVERAGE_CUTS", "1"}});
    EXPECT_EQ(program.set("RRCB_GRID", "0.01 0.05, 0 0.04"), ZOLTAN_OK);
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    for (int part = 0; part < 6; ++part) {
        const auto box = box_of(program, part);
        for (const std::size_t k : {0u, 3u}) {
            if (is_face(box[k])) {
                EXPECT_EQ(box[k], 0.01 + std::round((box[k] - 0.01) / 0.05) * 0.05);
            }
            if (is_face(box[k + 1])) {
                EXPECT_EQ(box[k + 1], std::round(box[k + 1] / 0.04) * 0.04);
            }
        }
    }
}

TEST(Limits, without_room_are_fatal_on_all_ranks_and_the_next_call_works) {
    Corner program;
    program.set({{"NUM_GLOBAL_PARTS", "9"}, {"RRCB_MIN_WIDTH", "0.4, 0.4"}});
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    program.set("RRCB_MIN_WIDTH", "1");  // one number for two axes
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    EXPECT_EQ(program.set("RRCB_MIN_WIDTH", "0 1"), ZOLTAN_WARN);
    EXPECT_EQ(program.set("RRCB_GRID", "0 0.1 0"), ZOLTAN_WARN);
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    EXPECT_EQ(program.set("RRCB_MIN_WIDTH", "DEFAULT"), ZOLTAN_OK);
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
}

TEST(Limits, that_differ_between_ranks_are_fatal_on_all) {
    Corner program;
    program.set("RRCB_GRID", program.rank == 0 ? "0 0.01 0 0.01" : "0 0.02 0 0.02");
    const int expected = program.num_ranks > 1 ? ZOLTAN_FATAL : ZOLTAN_OK;
    EXPECT_EQ(program.partition().code, expected);
}

TEST(Limits, are_refused_with_several_weights_and_with_turned_axes) {
    Corner program;
    program.set({{"RRCB_MIN_WIDTH", "0.01 0.01"}, {"REDUCE_DIMENSIONS", "1"}});
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    program.set({{"REDUCE_DIMENSIONS", "0"}, {"OBJ_WEIGHT_DIM", "2"}});
    program.further_weight = [](int, int) { return 1.0f; };
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    program.set("OBJ_WEIGHT_DIM", "1");
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
}

}  // namespace
}  // namespace rrcb::zoltan_test
