// RRCB_SKIP_WITHIN: objects that lie as the last cuts tell stay while they are even enough.
#include "moving.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

int num_messages = 0;
int num_reductions = 0;

}  // namespace

int MPI_Bcast(void* buffer, int count, MPI_Datatype type, int root, MPI_Comm comm) {
    ++num_messages;
    return PMPI_Bcast(buffer, count, type, root, comm);
}
int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
    ++num_reductions;
    return PMPI_Allreduce(in, out, count, type, op, comm);
}

namespace rrcb::zoltan_test {
namespace {

/// Objects of a unit square, each on the rank of its part.
struct Placed : Moving {
    explicit Placed(const char* skip_within, const char* reuse = "1", int num_parts = 0)
        : Moving(2) {
        std::mt19937 random(static_cast<unsigned>(7 + rank));
        std::uniform_real_distribution<double> uniform(0, 1);
        for (int i = 0; i < 400; ++i) add({uniform(random), uniform(random)});
        set("LB_METHOD", "RRCB");
        set("RCB_REUSE", reuse);
        set("RRCB_SKIP_WITHIN", skip_within);
        if (num_parts > 0) {
            set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
            tell_parts();
        }
        calls_until_rest(*this, 5);
    }

    /// The heaviest part over the mean, each rank one part.
    double imbalance() const {
        double here = 0;
        for (const float weight : weights) here += static_cast<double>(weight);
        double most = here;
        double all = here;
        MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        return most / all * num_ranks;
    }

    void weigh_first_rank(float factor) {
        if (rank == 0)
            for (float& weight : weights) weight *= factor;
    }

    int changes() {
        num_messages = num_reductions = 0;
        const Outcome outcome = partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        const bool has_lists = outcome.exports.count > 0 || outcome.imports.count > 0;
        EXPECT_TRUE(outcome.changes != 0 || !has_lists);
        return outcome.changes;
    }
};

TEST(Skip, keeps_objects_where_their_parts_are_even_enough_with_two_reductions) {
    for (const char* reuse : {"0", "1"}) {
        Placed program("1.2", reuse);
        program.weigh_first_rank(1.1F);
        ASSERT_LT(program.imbalance(), 1.2);
        EXPECT_EQ(program.changes(), 0);
        EXPECT_EQ(num_messages, 0);
        EXPECT_EQ(num_reductions, 2) << "the vote and the count";
        EXPECT_EQ(program.changes(), 0) << "again";
    }
}

TEST(Skip, is_off_by_default_and_ends_beyond_its_imbalance) {
    for (const char* skip_within : {"0", "1.2"}) {
        Placed program(skip_within);
        program.weigh_first_rank(skip_within[0] == '0' ? 1.1F : 1.5F);
        if (program.num_ranks < 3) return;
        EXPECT_GT(program.imbalance(), skip_within[0] == '0' ? 1.05 : 1.2);
        EXPECT_EQ(program.changes(), 1);
        EXPECT_GT(num_messages, 0);
    }
}

TEST(Skip, does_not_leave_objects_that_crossed_a_cut) {
    Placed program("2");
    if (program.num_ranks == 1) return;
    program.weigh_first_rank(1.1F);
    EXPECT_EQ(program.changes(), 0);
    // One object of the last rank goes to where one of the first lies.
    double there[2] = {0, 0};
    if (program.rank == 0) std::copy_n(program.coordinates.begin(), 2, there);
    MPI_Bcast(there, 2, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    if (program.rank == program.num_ranks - 1) std::copy_n(there, 2, program.coordinates.begin());
    EXPECT_EQ(program.changes(), 1);
}

TEST(Skip, counts_parts_by_name_and_by_their_sizes) {
    Program lone(2);
    Placed program("1.3", "1", 2 * lone.num_ranks);
    program.weigh_first_rank(1.1F);
    EXPECT_EQ(program.changes(), 0);
    EXPECT_EQ(num_messages, 0);
    // A quarter and three quarters where halves lie.
    std::vector<int> parts = {2 * program.rank, 2 * program.rank + 1};
    std::vector<int> weights = {0, 0};
    std::vector<float> sizes = {1, 3};
    Zoltan_LB_Set_Part_Sizes(program.zz, 1, 2, parts.data(), weights.data(), sizes.data());
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.changes, 1);
    program.send(outcome);
    calls_until_rest(program, 5);
    program.weigh_first_rank(1.05F);
    EXPECT_EQ(program.changes(), 0);
    EXPECT_EQ(num_messages, 0) << "counted by these sizes";
}

TEST(Skip, is_off_where_parts_have_a_least_width) {
    for (const bool on_lines : {true, false}) {
        Placed program("1.2");
        program.set(on_lines ? "RRCB_GRID" : "RRCB_MIN_WIDTH",
                    on_lines ? "0 0.001, 0 0.001" : "0.001 0.001");
        calls_until_rest(program, 5);
        program.weigh_first_rank(1.1F);
        program.changes();
        EXPECT_EQ(num_messages == 0, on_lines);
    }
}

TEST(Skip, of_an_illegal_value_warns_and_is_off) {
    for (const char* value : {"0.9", "-1", "nan", "inf", "1.1x", "much"}) {
        Program program(2);
        EXPECT_EQ(program.set("RRCB_SKIP_WITHIN", value), ZOLTAN_WARN) << value;
    }
}

TEST(Skip, is_the_same_on_all_ranks_or_refused) {
    Placed program("1.2");
    if (program.num_ranks == 1) return;
    if (program.rank == program.num_ranks - 1) program.set("RRCB_SKIP_WITHIN", "1.3");
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
}

}  // namespace
}  // namespace rrcb::zoltan_test
