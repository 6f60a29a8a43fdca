// Parts of a machine stay together under Zoltan's interface. The machines are made up: this program
// answers MPI_Comm_split_type in place of the MPI library.
#include "program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace rrcb::zoltan_test {
namespace {

int ranks_per_machine = 2;

using Boxes = std::vector<std::array<double, 4>>;

/// Box of the points on each machine: lower bounds, and upper bounds negated.
Boxes boxes_of_machines(const Program& program, const Outcome& outcome) {
    const auto num_machines =
        static_cast<std::size_t>((program.num_ranks - 1) / ranks_per_machine + 1);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Boxes boxes(num_machines, {infinity, infinity, infinity, infinity});
    const std::vector<int> parts = parts_by_object(outcome);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        auto& box = boxes[static_cast<std::size_t>(parts[i] / ranks_per_machine)];
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double x = program.coordinates[2 * i + axis];
            box[axis] = std::min(box[axis], x);
            box[2 + axis] = std::min(box[2 + axis], -x);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, boxes.data(), static_cast<int>(4 * num_machines), MPI_DOUBLE,
                  MPI_MIN, MPI_COMM_WORLD);
    return boxes;
}

bool overlap(const std::array<double, 4>& a, const std::array<double, 4>& b) {
    return a[0] < -b[2] && b[0] < -a[2] && a[1] < -b[3] && b[1] < -a[3];
}

bool are_apart(const Boxes& boxes) {
    for (std::size_t k = 0; k < boxes.size(); ++k)
        for (std::size_t l = 0; l < k; ++l)
            if (overlap(boxes[k], boxes[l])) return false;
    return true;
}

struct Scattered : Program {
    Scattered() {
        scatter_points(*this, 2000);
        set("LB_METHOD", "RRCB");
        set("OBJ_WEIGHT_DIM", "1");
        set("RETURN_LISTS", "PARTS");
    }

    bool keeps_machines_apart() {
        const Outcome outcome = partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        EXPECT_LT(imbalance(*this, outcome, num_ranks), 1.011);
        return are_apart(boxes_of_machines(*this, outcome));
    }
};

TEST(Machines, are_cut_off_whole_with_and_without_remap) {
    for (const char* remap : {"1", "0"}) {
        Scattered program;
        program.set("REMAP", remap);
        EXPECT_TRUE(program.keeps_machines_apart()) << "REMAP " << remap;
    }
}

TEST(Machines, are_cut_off_whole_from_earlier_cuts) {
    Scattered program;
    program.set("RCB_REUSE", "1");
    EXPECT_TRUE(program.keeps_machines_apart());
    for (double& x : program.coordinates) x += 0.01 * x;
    EXPECT_TRUE(program.keeps_machines_apart());
    program.set("RRCB_MACHINES", "OFF");
    EXPECT_FALSE(program.keeps_machines_apart());
    program.set("RRCB_MACHINES", "DEFAULT");
    EXPECT_TRUE(program.keeps_machines_apart());
    program.set("RCB_LOCK_DIRECTIONS", "1");
    EXPECT_TRUE(program.keeps_machines_apart());
    EXPECT_TRUE(program.keeps_machines_apart());
}

TEST(Machines, are_not_looked_at_if_that_is_switched_off) {
    Scattered program;
    EXPECT_EQ(program.set("RRCB_MACHINES", "off"), ZOLTAN_OK);
    EXPECT_FALSE(program.keeps_machines_apart());
    EXPECT_EQ(program.set("RRCB_MACHINES", "SOMETIMES"), ZOLTAN_WARN);
    EXPECT_TRUE(program.keeps_machines_apart());
}

TEST(Machines, do_not_matter_if_parts_lie_unevenly) {
    Scattered program;
    program.set("NUM_LOCAL_PARTS", program.rank == 0 ? "2" : "1");
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    EXPECT_LT(imbalance(program, outcome, program.num_ranks + 1), 1.011);
}

}  // namespace
}  // namespace rrcb::zoltan_test

extern "C" int MPI_Comm_split_type(MPI_Comm comm, int, int key, MPI_Info, MPI_Comm* made) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    return PMPI_Comm_split(comm, rank / rrcb::zoltan_test::ranks_per_machine, key, made);
}
