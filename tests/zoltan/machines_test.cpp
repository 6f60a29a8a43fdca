// Parts of a machine stay together under Zoltan's interface. The machines are made up: this program
// answers MPI_Comm_split_type in place of the MPI library.
#include "program.hpp"
#include "regions.hpp"

namespace rrcb::zoltan_test {
namespace {

int ranks_per_machine = 2;
bool is_dealt = false;  ///< to half as many machines as ranks

int num_machines(int num_ranks) {
    return (num_ranks - 1) / ranks_per_machine + 1;
}
int machine_of(int rank, int num_ranks) {
    return is_dealt ? rank % num_machines(num_ranks) : rank / ranks_per_machine;
}

using Boxes = std::vector<std::array<double, 4>>;

/// Box of the points on each machine: lower bounds, and upper bounds negated.
Boxes boxes_of_machines(const Program& program, const Outcome& outcome) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Boxes boxes(static_cast<std::size_t>(num_machines(program.num_ranks)),
                {infinity, infinity, infinity, infinity});
    const std::vector<int> parts = parts_by_object(outcome);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        auto& box = boxes[static_cast<std::size_t>(machine_of(parts[i], program.num_ranks))];
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const double x = program.coordinates[2 * i + axis];
            box[axis] = std::min(box[axis], x);
            box[2 + axis] = std::min(box[2 + axis], -x);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, boxes.data(), static_cast<int>(4 * boxes.size()), MPI_DOUBLE,
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
        set({{"LB_METHOD", "RRCB"}, {"OBJ_WEIGHT_DIM", "1"}, {"RETURN_LISTS", "PARTS"}});
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
        program.set({{"REMAP", remap}, {"RRCB_MACHINES", "ON"}});
        EXPECT_TRUE(program.keeps_machines_apart()) << "REMAP " << remap;
    }
}

TEST(Machines, are_cut_off_whole_from_earlier_cuts) {
    Scattered program;
    program.set({{"RCB_REUSE", "1"}, {"RRCB_MACHINES", "ON"}});
    EXPECT_TRUE(program.keeps_machines_apart());
    for (double& x : program.coordinates) x += 0.01 * x;
    EXPECT_TRUE(program.keeps_machines_apart());
    program.set("RRCB_MACHINES", "OFF");
    EXPECT_FALSE(program.keeps_machines_apart());
    program.set("RRCB_MACHINES", "ON");
    EXPECT_TRUE(program.keeps_machines_apart());
    program.set("RCB_LOCK_DIRECTIONS", "1");
    EXPECT_TRUE(program.keeps_machines_apart());
    EXPECT_TRUE(program.keeps_machines_apart());
}

/// The look-ups of each object find its part, which its rank has.
void expect_own_parts(Scattered& program, const Outcome& outcome) {
    const std::vector<int> parts = parts_by_object(outcome);
    for (std::size_t i = 0; i < parts.size(); ++i) expect_found(program, i, parts[i], parts[i]);
}

TEST(Machines, to_which_ranks_are_dealt_in_turn_are_cut_off_whole) {
    is_dealt = true;
    for (const char* remap : {"1", "0"}) {
        SCOPED_TRACE(remap);
        Scattered program;
        program.set({{"REMAP", remap}, {"KEEP_CUTS", "1"}, {"RRCB_MACHINES", "ON"}});
        const Outcome outcome = program.partition();
        EXPECT_TRUE(are_apart(boxes_of_machines(program, outcome)));
        expect_own_parts(program, outcome);
        for (double& x : program.coordinates) x += 0.01 * x;
        program.set("RCB_REUSE", "1");
        const Outcome again = program.partition();
        EXPECT_TRUE(are_apart(boxes_of_machines(program, again)));
        expect_own_parts(program, again);
    }
    is_dealt = false;
}

TEST(Machines, are_looked_at_only_if_that_is_switched_on) {
    Scattered program;
    EXPECT_FALSE(program.keeps_machines_apart());
    EXPECT_EQ(program.set("RRCB_MACHINES", "on"), ZOLTAN_OK);
    EXPECT_TRUE(program.keeps_machines_apart());
    EXPECT_EQ(program.set("RRCB_MACHINES", "SOMETIMES"), ZOLTAN_WARN);
    EXPECT_TRUE(program.keeps_machines_apart());
    EXPECT_EQ(program.set("RRCB_MACHINES", "DEFAULT"), ZOLTAN_OK);
    EXPECT_FALSE(program.keeps_machines_apart());
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
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    return PMPI_Comm_split(comm, rrcb::zoltan_test::machine_of(rank, num_ranks), key, made);
}
