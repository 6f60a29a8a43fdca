// Look-ups of a program whose parts many ranks make, beside the parts of its objects.
#include "program.hpp"
#include "regions.hpp"

#include <gtest/gtest.h>
#include <zoltan_partition_tree.h>

#include <algorithm>
#include <string>
#include <vector>

namespace rrcb::zoltan_test {
namespace {

struct SpreadProgram : Program {
    explicit SpreadProgram(int num_parts, int count = 300) {
        scatter_points(*this, count);
        set("LB_METHOD", "RRCB");
        set("RRCB_CENTRAL_PARTS", "2");
        set("RRCB_COINCIDENT", "TOGETHER");
        set("RETURN_LISTS", "PARTS");
        set("REMAP", "0");
        set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    }
};

/// Objects of all ranks and their parts, on every rank.
struct AllObjects {
    std::vector<double> coordinates;
    std::vector<int> parts;

    AllObjects(const Program& program, const Outcome& outcome) {
        const std::vector<int> mine = parts_by_object(outcome);
        const int count = static_cast<int>(mine.size());
        const auto num_ranks = static_cast<std::size_t>(program.num_ranks);
        parts.resize(mine.size() * num_ranks);
        coordinates.resize(2 * parts.size());
        MPI_Allgather(mine.data(), count, MPI_INT, parts.data(), count, MPI_INT, MPI_COMM_WORLD);
        MPI_Allgather(program.coordinates.data(), 2 * count, MPI_DOUBLE, coordinates.data(),
                      2 * count, MPI_DOUBLE, MPI_COMM_WORLD);
    }
};

/// Every rank finds the objects of all ranks in their parts, by each kind of look-up.
void expect_look_ups(Zoltan_Struct* zz, AllObjects& all, int num_parts) {
    std::vector<int> touched(static_cast<std::size_t>(num_parts));
    std::vector<int> ranks(touched.size());
    for (std::size_t i = 0; i < all.parts.size(); ++i) {
        double* x = &all.coordinates[2 * i];
        int rank = -1, part = -1, num_ranks = 0, count = 0;
        ASSERT_EQ(Zoltan_LB_Point_PP_Assign(zz, x, &rank, &part), ZOLTAN_OK);
        ASSERT_EQ(part, all.parts[i]);
        if (i % 16 != 0) continue;
        ASSERT_EQ(Zoltan_LB_Box_PP_Assign(zz, x[0] - 1e-3, x[1] - 1e-3, 0, x[0] + 1e-3, x[1] + 1e-3,
                                          0, ranks.data(), &num_ranks, touched.data(), &count),
                  ZOLTAN_OK);
        const auto end = touched.begin() + count;
        EXPECT_TRUE(std::is_sorted(touched.begin(), end));
        EXPECT_TRUE(std::binary_search(touched.begin(), end, part));
        const Region region = region_of(zz, part);
        for (std::size_t a = 0; a < 2; ++a) {
            EXPECT_LE(region.lower[a], x[a]);
            EXPECT_GE(region.upper[a], x[a]);
        }
    }
}

TEST(SpreadCuts, are_shown_to_look_ups_on_every_rank) {
    for (const int num_parts : {5, 40}) {
        SpreadProgram program(num_parts);
        program.set({{"KEEP_CUTS", "1"}, {"REMAP", num_parts == 40 ? "1" : "0"}});
        AllObjects all(program, program.partition());
        expect_look_ups(program.zz, all, num_parts);
        // A copy has its own cuts, also when the original is gone.
        Zoltan_Struct* copy = Zoltan_Copy(program.zz);
        std::vector<char> bytes(Zoltan_Serialize_Size(program.zz));
        ASSERT_EQ(Zoltan_Serialize(program.zz, bytes.size(), bytes.data()), ZOLTAN_OK);
        Zoltan_Destroy(&program.zz);
        expect_look_ups(copy, all, num_parts);
        Zoltan_Struct* unpacked = Zoltan_Create(MPI_COMM_WORLD);
        ASSERT_EQ(Zoltan_Deserialize(unpacked, bytes.size(), bytes.data()), ZOLTAN_OK);
        expect_look_ups(unpacked, all, num_parts);
        Zoltan_Destroy(&copy);
        Zoltan_Destroy(&unpacked);
    }
}

TEST(SpreadCuts, are_shown_anew_after_each_partition) {
    SpreadProgram program(40, 200);
    program.set("KEEP_CUTS", "1");
    for (const char* num_parts : {"40", "41", "30"}) {
        program.set("NUM_GLOBAL_PARTS", num_parts);
        for (double& x : program.coordinates) x *= x;
        AllObjects all(program, program.partition());
        expect_look_ups(program.zz, all, std::stoi(num_parts));
    }
}

TEST(SpreadCuts, form_the_tree_that_zoltan_walks) {
    const int num_parts = 37;
    SpreadProgram program(num_parts);
    program.set("KEEP_CUTS", "1");
    program.partition();
    int parent = 0, lower = 0, root = 0;
    ASSERT_EQ(Zoltan_RCB_Partition_Tree(program.zz, 0, &parent, &lower, &root), ZOLTAN_OK);
    EXPECT_EQ(root, num_parts / 2);
    std::vector<int> is_named(static_cast<std::size_t>(num_parts));
    for (int node = 1; node < num_parts; ++node) {
        int upper = 0;
        ASSERT_EQ(Zoltan_RCB_Partition_Tree(program.zz, node, &parent, &lower, &upper), ZOLTAN_OK);
        for (const int child : {lower, upper}) {
            if (child <= 0) is_named[static_cast<std::size_t>(-child)] += 1;
            if (child <= 0) continue;
            int of_child = 0, unused = 0;
            Zoltan_RCB_Partition_Tree(program.zz, child, &of_child, &unused, &unused);
            EXPECT_EQ(of_child, child == lower ? node + 1 : -(node + 1));
        }
    }
    EXPECT_EQ(is_named, std::vector<int>(static_cast<std::size_t>(num_parts), 1));
}

TEST(SpreadCuts, are_for_the_ranks_that_keep_them) {
    SpreadProgram program(50);
    program.partition();
    int rank = 0, part = 0;
    EXPECT_EQ(Zoltan_LB_Point_PP_Assign(program.zz, program.coordinates.data(), &rank, &part),
              ZOLTAN_FATAL);
    // Asked for on one rank, after a partition whose objects stay as they are.
    const bool keeps = program.rank == program.num_ranks - 1;
    if (keeps) program.set("KEEP_CUTS", "1");
    AllObjects all(program, program.partition());
    if (keeps) return expect_look_ups(program.zz, all, 50);
    EXPECT_EQ(Zoltan_LB_Point_PP_Assign(program.zz, program.coordinates.data(), &rank, &part),
              ZOLTAN_FATAL);
}

/// Objects in the parts that a partition gave them.
void migrate(Program& program, const Outcome& outcome) {
    AllObjects all(program, outcome);
    std::vector<float> weights(all.parts.size());
    MPI_Allgather(program.weights.data(), program.size(), MPI_FLOAT, weights.data(), program.size(),
                  MPI_FLOAT, MPI_COMM_WORLD);
    program.coordinates.clear();
    program.weights.clear();
    for (std::size_t i = 0; i < all.parts.size(); ++i)
        if (all.parts[i] == program.rank)
            program.add({all.coordinates[2 * i], all.coordinates[2 * i + 1]}, weights[i]);
}

TEST(SpreadCuts, leave_objects_at_rest_that_were_sent_where_they_are) {
    for (const char* remap : {"0", "1"}) {
        SpreadProgram program(Program().num_ranks);
        program.set("REMAP", remap);
        migrate(program, program.partition());
        // Numbers may still be exchanged by the first call on them.
        program.partition();
        const Outcome again = program.partition();
        EXPECT_EQ(again.code, ZOLTAN_OK);
        const std::vector<int> parts = parts_by_object(again);
        EXPECT_EQ(std::ranges::count(parts, program.rank), std::ssize(parts));
    }
}

TEST(SpreadCuts, are_reused_while_their_parts_are_within_the_tolerance) {
    SpreadProgram program(40, 1000);
    program.set("IMBALANCE_TOL", "1.5");
    program.set("RCB_REUSE", "1");
    AllObjects first(program, program.partition());
    for (double& x : program.coordinates) x += 1e-7;
    AllObjects again(program, program.partition());
    std::size_t num_moved = 0;
    for (std::size_t i = 0; i < first.parts.size(); ++i)
        num_moved += first.parts[i] != again.parts[i] ? 1 : 0;
    EXPECT_LE(num_moved, 5u);
    expect_look_ups(program.zz, again, 40);
}

}  // namespace
}  // namespace rrcb::zoltan_test
