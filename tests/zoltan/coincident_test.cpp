#include "program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rrcb::zoltan_test {
namespace {

/// Objects of all ranks in each part, the fewest first: RCB may name the parts otherwise.
std::vector<int> counts(const Outcome& outcome, int num_parts) {
    std::vector<int> result(static_cast<std::size_t>(num_parts), 0);
    for (const int part : outcome.exports.parts) ++result[static_cast<std::size_t>(part)];
    MPI_Allreduce(MPI_IN_PLACE, result.data(), num_parts, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    std::ranges::sort(result);
    return result;
}

constexpr int num_parts = 4;

std::vector<int> counts_with(Program& program, const char* method) {
    program.set("LB_METHOD", method);
    program.set("RRCB_REFINE", "EXACT");
    program.set("RETURN_LISTS", "PARTS");
    program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    return counts(outcome, num_parts);
}

TEST(Coincident, objects_are_divided_by_number_as_by_zoltan) {
    Program one_place(2), two_places(2);
    for (int i = 0; i < 100; ++i) one_place.add({3, 4});
    for (int i = 0; i < 100; ++i) two_places.add({i % 5 == 0 ? 1.0 : 2.0, 0});
    for (Program* program : {&one_place, &two_places}) {
        const std::vector<int> even(num_parts, 25 * program->num_ranks);
        EXPECT_EQ(counts_with(*program, "RCB"), even);
        EXPECT_EQ(counts_with(*program, "RRCB"), even);
    }
}

TEST(Coincident, objects_stay_together_where_that_is_asked_for) {
    Program program(2);
    for (int i = 0; i < 100; ++i) program.add({3, 4});
    EXPECT_EQ(program.set("RRCB_COINCIDENT", "together"), ZOLTAN_OK);
    EXPECT_EQ(counts_with(program, "RRCB"), (std::vector<int>{0, 0, 0, 100 * program.num_ranks}));
    EXPECT_EQ(program.set("RRCB_COINCIDENT", "DEFAULT"), ZOLTAN_OK);
    EXPECT_EQ(program.set("RRCB_COINCIDENT", "APART"), ZOLTAN_WARN);
    EXPECT_EQ(counts_with(program, "RRCB"), std::vector<int>(num_parts, 25 * program.num_ranks));
}

TEST(Coincident, objects_in_a_plane_stay_together_in_rectilinear_blocks) {
    Program program(1);
    for (int i = 0; i < 100; ++i) program.add({i < 10 ? 0.0 : 1.0});
    program.set("RCB_RECTILINEAR_BLOCKS", "1");
    const int ranks = program.num_ranks;
    EXPECT_EQ(counts_with(program, "RRCB"), (std::vector<int>{0, 0, 10 * ranks, 90 * ranks}));
}

TEST(Coincident, objects_are_looked_up_in_a_part_with_objects_in_their_place) {
    std::mt19937_64 engine(4);
    for (int round = 0; round < 400; ++round) {
        const auto dimension = 1 + engine() % 3;
        std::vector<int> parts_at(1 + engine() % 4, 0);
        Program program(static_cast<int>(dimension));
        std::vector<std::size_t> places;
        for (auto left = 1 + engine() % 30; left > 0; --left) {
            const auto place = engine() % parts_at.size();
            const auto home = engine() % static_cast<unsigned>(program.num_ranks);
            const float weight = engine() % 5 == 0 ? 9 : 1;
            if (static_cast<int>(home) != program.rank) continue;
            program.add(std::vector<double>(dimension, static_cast<double>(place)), weight);
            places.push_back(place);
        }
        program.set("LB_METHOD", "RRCB");
        program.set("KEEP_CUTS", "1");
        program.set("RETURN_LISTS", "PARTS");
        program.set("OBJ_WEIGHT_DIM", round % 2 == 0 ? "0" : "1");
        program.set("NUM_GLOBAL_PARTS", std::to_string(2 + round % 8));
        const std::vector<int> parts = parts_by_object(program.partition());
        for (std::size_t i = 0; i < parts.size(); ++i) parts_at[places[i]] |= 1 << parts[i];
        MPI_Allreduce(MPI_IN_PLACE, parts_at.data(), static_cast<int>(parts_at.size()), MPI_INT,
                      MPI_BOR, MPI_COMM_WORLD);
        for (std::size_t place = 0; place < parts_at.size(); ++place) {
            if (parts_at[place] == 0) continue;
            std::vector<double> x(3, static_cast<double>(place));
            int owner = -1, part = -1;
            ASSERT_EQ(Zoltan_LB_Point_PP_Assign(program.zz, x.data(), &owner, &part), ZOLTAN_OK);
            EXPECT_NE(parts_at[place] & (1 << part), 0) << "round " << round;
        }
    }
}

TEST(Coincident, that_differs_between_ranks_is_fatal) {
    Program program;
    if (program.num_ranks == 1) GTEST_SKIP() << "needs two ranks";
    scatter_points(program, 100);
    program.set("LB_METHOD", "RRCB");
    program.set("RRCB_COINCIDENT", program.rank == 0 ? "DIVIDE" : "TOGETHER");
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
}

}  // namespace
}  // namespace rrcb::zoltan_test
