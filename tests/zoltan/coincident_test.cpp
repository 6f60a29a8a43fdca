#include "program.hpp"

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
    program.set({{"LB_METHOD", method}, {"RRCB_REFINE", "EXACT"}, {"RETURN_LISTS", "PARTS"}});
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

TEST(Coincident, planes_are_the_cause_that_a_warning_names) {
    Program program(2);
    if (program.rank == 0)
        for (int i = 0; i < 25; ++i) program.add({1.0 * (i % 5), 1.0 * (i / 5)});
    program.set({{"RCB_RECTILINEAR_BLOCKS", "1"}, {"DEBUG_LEVEL", "1"}});
    testing::internal::CaptureStderr();
    counts_with(program, "RRCB");
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(said.find("outweighs"), std::string::npos) << said;
    EXPECT_EQ(said.find("plane, which RCB_RECTILINEAR_BLOCKS keeps together") != said.npos,
              program.rank == 0)
        << said;
}

}  // namespace
}  // namespace rrcb::zoltan_test
