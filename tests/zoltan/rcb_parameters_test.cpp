#include "program.hpp"
#include "regions.hpp"

#include <cstdio>

namespace rrcb::zoltan_test {
namespace {

/// Points of all ranks in a box of these extents.
void fill_box(Program& program, const std::array<double, 3>& extents, int count) {
    scatter_points(program, count);
    for (std::size_t i = 0; i < program.coordinates.size(); ++i) {
        program.coordinates[i] *= extents[i % static_cast<std::size_t>(program.dimension)];
    }
}

constexpr std::array methods = {"RCB", "RRCB"};

TEST(SetDirections, cuts_across_the_axes_in_each_of_the_six_orders) {
    constexpr std::array<const char*, 6> orders = {"xyz", "xzy", "yzx", "yxz", "zxy", "zyx"};
    for (int setting = 1; setting <= 6; ++setting) {
        for (const char* method : methods) {
            Program program(3);
            fill_box(program, {1.00, 0.99, 0.98}, 2000);
            program.set({{"LB_METHOD", method}, {"RCB_SET_DIRECTIONS", std::to_string(setting)}});
            program.set({{"NUM_GLOBAL_PARTS", "8"}, {"KEEP_CUTS", "1"}});
            program.partition();
            const auto planes = planes_per_axis(program, 8);
            const std::string order = orders[static_cast<std::size_t>(setting - 1)];
            if (program.rank == 0) {
                std::printf("RCB_SET_DIRECTIONS=%d (%s) %-4s planes across x %d, y %d, z %d\n",
                            setting, order.c_str(), method, planes[0], planes[1], planes[2]);
            }
            if (method == methods[0]) continue;  // never cuts z at 1 and 4
            // A cube in 8 parts: one cut, then one in each half, then one in each quarter.
            for (std::size_t level = 0; level < 3; ++level) {
                const auto axis = static_cast<std::size_t>(order[level] - 'x');
                EXPECT_EQ(planes[axis], 1 << level) << order << ' ' << order[level];
            }
        }
    }
}

TEST(SetDirections, works_in_the_plane_and_warns_out_of_bounds) {
    for (const char* setting : {"4", "7"}) {
        Program program;
        fill_box(program, {4, 1, 0}, 500);
        program.set({{"LB_METHOD", "RRCB"}, {"RCB_SET_DIRECTIONS", setting}, {"KEEP_CUTS", "1"}});
        program.set("NUM_GLOBAL_PARTS", "2");
        EXPECT_EQ(program.partition().code, ZOLTAN_OK);
        const auto planes = planes_per_axis(program, 2);
        EXPECT_EQ(planes[0] + planes[1], 1);
    }
}

TEST(LockDirections, keep_the_axes_of_the_first_call) {
    for (const char* method : methods) {
        for (const bool locked : {false, true}) {
            SCOPED_TRACE(std::string(method) + (locked ? " locked" : " free"));
            Program program;
            fill_box(program, {4, 1, 0}, 1000);
            program.set({{"LB_METHOD", method}, {"RCB_LOCK_DIRECTIONS", locked ? "1" : "0"}});
            program.set({{"KEEP_CUTS", "1"}, {"NUM_GLOBAL_PARTS", "2"}});
            program.partition();
            EXPECT_EQ(planes_per_axis(program, 2), (std::array{1, 0, 0}));
            for (std::size_t i = 1; i < program.coordinates.size(); i += 2) {
                program.coordinates[i] *= 16;
            }
            program.partition();
            const std::array expected = locked ? std::array{1, 0, 0} : std::array{0, 1, 0};
            EXPECT_EQ(planes_per_axis(program, 2), expected);
        }
    }
}

TEST(LockDirections, start_anew_for_another_number_of_parts) {
    Program program;
    fill_box(program, {4, 1, 0}, 1000);
    program.set({{"LB_METHOD", "RRCB"}, {"RCB_LOCK_DIRECTIONS", "1"}});
    program.partition();
    program.set("NUM_GLOBAL_PARTS", std::to_string(program.num_ranks + 3));
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
}

TEST(Reuse, balances_from_the_cuts_of_the_last_call) {
    for (const char* method : methods) {
        SCOPED_TRACE(method);
        Program program;
        fill_box(program, {1, 1, 0}, 3000);
        program.set({{"LB_METHOD", method}, {"RCB_REUSE", "1"}, {"RETURN_LISTS", "PARTS"}});
        program.set({{"IMBALANCE_TOL", "1.005"}, {"OBJ_WEIGHT_DIM", "1"}});
        program.set("NUM_GLOBAL_PARTS", "5");
        for (int step = 0; step < 4; ++step) {
            const Outcome outcome = program.partition();
            EXPECT_EQ(outcome.code, ZOLTAN_OK);
            EXPECT_LT(imbalance(program, outcome, 5), 1.006);
            for (double& x : program.coordinates) x += 0.01 * x * x;
        }
    }
}

/// A lattice of `side` x `side` points, dealt out to the ranks, each at the same place for all.
void fill_lattice(Program& program, int side) {
    for (int i = program.rank; i < side * side; i += program.num_ranks) {
        program.add({double(i % side), double(i / side)});
    }
}

TEST(RectilinearBlocks, keep_points_of_one_plane_together) {
    // 9 columns in 2 parts: 4 or 5 columns with planes, halves to one point without.
    for (const char* method : methods) {
        for (const bool rectilinear : {false, true}) {
            SCOPED_TRACE(std::string(method) + (rectilinear ? " rectilinear" : ""));
            Program program;
            fill_lattice(program, 9);
            program.set("LB_METHOD", method);
            program.set("RCB_RECTILINEAR_BLOCKS", rectilinear ? "1" : "0");
            program.set({{"RETURN_LISTS", "PARTS"}, {"NUM_GLOBAL_PARTS", "2"}});
            const Outcome outcome = program.partition();
            std::array<std::array<int, 9>, 2> columns{};
            const std::vector<int> parts = parts_by_object(outcome);
            for (std::size_t i = 0; i < parts.size(); ++i) {
                const auto part = static_cast<std::size_t>(parts[i]);
                ++columns[part][static_cast<std::size_t>(program.coordinates[2 * i])];
            }
            MPI_Allreduce(MPI_IN_PLACE, columns.data(), 18, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
            int num_split = 0;
            for (std::size_t c = 0; c < 9; ++c) num_split += columns[0][c] * columns[1][c] > 0;
            EXPECT_EQ(num_split, rectilinear ? 0 : 1);
        }
    }
}

TEST(Shortcomings, are_told_and_do_not_change_the_code) {
    Program program;
    fill_box(program, {1, 1, 0}, 200);
    program.set({{"LB_METHOD", "RRCB"}, {"DEBUG_LEVEL", "1"}, {"RCB_SET_DIRECTIONS", "9"}});
    program.set("RCB_OUTPUT_LEVEL", "1");
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    const std::string warnings = testing::internal::GetCapturedStderr();
    const std::string output = testing::internal::GetCapturedStdout();
    const bool first = program.rank == 0;
    EXPECT_EQ(warnings.find("WARNING") != warnings.npos, first) << warnings;
    EXPECT_EQ(warnings.find("RCB_SET_DIRECTIONS") != warnings.npos, first) << warnings;
    EXPECT_EQ(output.find("imbalance") != output.npos, first) << output;
}

}  // namespace
}  // namespace rrcb::zoltan_test
