#include "program.hpp"

#include <cfloat>

namespace rrcb::zoltan_test {
namespace {

struct KeptProgram : Program {
    explicit KeptProgram(int num_parts = 0, int dimension_ = 2) : Program(dimension_) {
        scatter_points(*this, 400);
        set({{"LB_METHOD", "RRCB"}, {"RETURN_LISTS", "PARTS"}, {"KEEP_CUTS", "1"}});
        if (num_parts > 0) set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    }
    double* position(int i) { return &coordinates[static_cast<std::size_t>(i * dimension)]; }
};

TEST(LookUps, without_parts_ask_for_one_part_per_rank) {
    KeptProgram same, other(Program().num_ranks + 1);
    const Outcome outcome = same.partition();
    other.partition();
    int rank = -2, count = -2;
    std::vector<int> ranks(static_cast<std::size_t>(same.num_ranks));
    EXPECT_EQ(Zoltan_LB_Point_PP_Assign(same.zz, same.position(0), nullptr, nullptr), ZOLTAN_OK);
    EXPECT_EQ(Zoltan_LB_Point_Assign(same.zz, same.position(0), &rank), ZOLTAN_OK);
    EXPECT_EQ(rank, outcome.exports.ranks[0]);
    EXPECT_EQ(Zoltan_LB_Box_Assign(same.zz, -1, -1, 0, 2, 2, 0, ranks.data(), &count), ZOLTAN_OK);
    EXPECT_EQ(count, same.num_ranks);
    EXPECT_EQ(Zoltan_LB_Point_Assign(other.zz, other.position(0), &rank), ZOLTAN_FATAL);
    EXPECT_EQ(rank, -1);
    EXPECT_EQ(Zoltan_LB_Box_Assign(other.zz, 0, 0, 0, 1, 1, 0, ranks.data(), &count), ZOLTAN_FATAL);
    EXPECT_EQ(count, 0);
}

TEST(LookUps, of_boxes_find_the_parts_and_ranks_of_all_points_inside) {
    const int num_ranks = Program().num_ranks;
    for (const int num_parts : {1, num_ranks, 2 * num_ranks + 1}) {
        KeptProgram program(num_parts);
        program.partition();
        std::vector<int> ranks(static_cast<std::size_t>(num_ranks));
        std::vector<int> parts(static_cast<std::size_t>(num_parts));
        int rank_count = 0, part_count = 0;
        ASSERT_EQ(Zoltan_LB_Box_PP_Assign(program.zz, 0.2, 0.3, 0, 0.7, 0.6, 0, ranks.data(),
                                          &rank_count, parts.data(), &part_count),
                  ZOLTAN_OK);
        ranks.resize(static_cast<std::size_t>(rank_count));
        parts.resize(static_cast<std::size_t>(part_count));
        EXPECT_TRUE(std::ranges::is_sorted(ranks));
        EXPECT_EQ(std::ranges::adjacent_find(ranks), ranks.end());
        for (double x = 0.2; x <= 0.7; x += 0.01) {
            for (double y = 0.3; y <= 0.6; y += 0.01) {
                double position[] = {x, y};
                int rank = 0, part = 0;
                Zoltan_LB_Point_PP_Assign(program.zz, position, &rank, &part);
                EXPECT_TRUE(std::ranges::binary_search(parts, part));
                EXPECT_TRUE(std::ranges::binary_search(ranks, rank));
            }
        }
    }
}

TEST(LookUps, of_boxes_write_what_zoltan_writes_for_what_is_not_asked) {
    for (const char* method : {"RCB", "RRCB"}) {
        SCOPED_TRACE(method);
        KeptProgram program;
        program.set("LB_METHOD", method);
        program.partition();
        std::vector<int> found(static_cast<std::size_t>(program.num_ranks));
        int rank_count = -7, part_count = -7;
        Zoltan_LB_Box_PP_Assign(program.zz, -9, -9, 0, 9, 9, 0, found.data(), &rank_count, nullptr,
                                &part_count);
        EXPECT_EQ(rank_count, program.num_ranks);
        EXPECT_EQ(part_count, 0);
        Zoltan_LB_Box_PP_Assign(program.zz, -9, -9, 0, 9, 9, 0, nullptr, &rank_count, found.data(),
                                &part_count);
        EXPECT_EQ(rank_count, 0);
        EXPECT_EQ(part_count, program.num_ranks);
    }
}

TEST(LookUps, of_the_box_of_a_part_have_open_sides_at_the_largest_doubles) {
    KeptProgram program(2);
    const Outcome outcome = program.partition();
    for (int part = 0; part < 2; ++part) {
        int dimension = 0;
        double lo[3], hi[3];
        ASSERT_EQ(Zoltan_RCB_Box(program.zz, part, &dimension, &lo[0], &lo[1], &lo[2], &hi[0],
                                 &hi[1], &hi[2]),
                  ZOLTAN_OK);
        EXPECT_EQ(dimension, 2);
        EXPECT_EQ(lo[2], -DBL_MAX);
        EXPECT_EQ(hi[2], DBL_MAX);
        const auto num_open = std::count(lo, lo + 2, -DBL_MAX) + std::count(hi, hi + 2, DBL_MAX);
        EXPECT_EQ(num_open, 3);
        for (int i = 0; i < program.size(); ++i) {
            if (outcome.exports.parts[static_cast<std::size_t>(i)] != part) continue;
            for (int a = 0; a < 2; ++a) {
                EXPECT_GE(program.position(i)[a], lo[a]);
                EXPECT_LE(program.position(i)[a], hi[a]);
            }
        }
    }
}

void expect_no_cuts(KeptProgram& program) {
    int rank = 5, part = 5, count = 5, parts = 5;
    double lo[3], hi[3];
    EXPECT_EQ(Zoltan_LB_Point_PP_Assign(program.zz, program.position(0), &rank, &part),
              ZOLTAN_FATAL);
    EXPECT_EQ(rank, -1);
    EXPECT_EQ(part, -1);
    EXPECT_EQ(Zoltan_LB_Box_PP_Assign(program.zz, 0, 0, 0, 1, 1, 0, &rank, &count, &part, &parts),
              ZOLTAN_FATAL);
    EXPECT_EQ(count, 0);
    EXPECT_EQ(parts, 0);
    EXPECT_EQ(Zoltan_RCB_Box(program.zz, 0, &count, &lo[0], &lo[1], &lo[2], &hi[0], &hi[1], &hi[2]),
              ZOLTAN_FATAL);
    EXPECT_EQ(count, -1);
}

TEST(LookUps, without_kept_cuts_are_fatal) {
    KeptProgram program;
    expect_no_cuts(program);
    program.set("KEEP_CUTS", "0");
    program.partition();
    expect_no_cuts(program);
}

TEST(LookUps, are_not_answered_from_cuts_of_a_call_that_failed) {
    KeptProgram program;
    program.partition();
    program.set("RETURN_LISTS", "CANDIDATE LISTS");
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    expect_no_cuts(program);
}

TEST(LookUps, of_an_unknown_part_are_fatal) {
    KeptProgram program;
    program.partition();
    int dimension = 0;
    double lo[3], hi[3];
    for (const int part : {-1, program.num_ranks}) {
        EXPECT_EQ(Zoltan_RCB_Box(program.zz, part, &dimension, &lo[0], &lo[1], &lo[2], &hi[0],
                                 &hi[1], &hi[2]),
                  ZOLTAN_FATAL);
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
