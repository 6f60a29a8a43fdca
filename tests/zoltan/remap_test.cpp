#include "program.hpp"
#include "regions.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace rrcb::zoltan_test {
namespace {

/// Share of the objects of all ranks that leave their rank.
double moved(const Program& program, const Outcome& outcome) {
    double counts[2] = {0, double(program.size())};
    for (std::size_t i = 0; i < outcome.exports.ranks.size(); ++i) {
        if (outcome.exports.ranks[i] != program.rank) counts[0] += 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return counts[0] / counts[1];
}

/// Stripes across x, dealt out so that rank r holds the stripe of number (r + 1) % ranks.
struct Rotated : Program {
    Rotated() {
        scatter_points(*this, 1000);
        for (std::size_t i = 0; i < coordinates.size(); i += 2) {
            coordinates[i] += (rank + 1) % num_ranks;
            coordinates[i + 1] *= 0.01;
        }
        set("RETURN_LISTS", "PARTS");
    }
};

double moved_with(Program& program, const char* method, const char* remap) {
    program.set({{"LB_METHOD", method}, {"REMAP", remap}});
    const Outcome outcome = program.partition();
    EXPECT_EQ(outcome.code, ZOLTAN_OK);
    return moved(program, outcome);
}

TEST(Remap, keeps_rotated_stripes_where_they_are) {
    Rotated program;
    if (program.num_ranks == 1) GTEST_SKIP() << "needs two ranks";
    const double zoltan = moved_with(program, "RCB", "1");
    const double without = moved_with(program, "RRCB", "0");
    const double with = moved_with(program, "RRCB", "1");
    if (program.rank == 0) {
        std::printf("moved: %.4f without REMAP, %.4f with it, %.4f by Zoltan\n", without, with,
                    zoltan);
    }
    EXPECT_GT(without, 0.9);
    // The stripes hold equal weights; only what the tolerance of 1 % lets slip may move.
    EXPECT_LT(with, 0.02 * program.num_ranks);
    EXPECT_LE(with, zoltan + 0.02 * program.num_ranks);
}

TEST(Remap, takes_words_as_zoltan_does) {
    // DEFAULT is not what a new handle has.
    for (const char* word : {"1", "0", "TRUE", "FALSE", "-1", "DEFAULT"}) {
        Rotated program;
        EXPECT_EQ(moved_with(program, "RRCB", word) > 0.9, moved_with(program, "RCB", word) > 0.9)
            << word;
    }
}

TEST(Remap, moves_no_more_than_zoltans_on_scattered_points) {
    // Both get the very cuts of the median; the numbers alone differ.
    for (unsigned seed = 0; seed < 10; ++seed) {
        Scattered program(500);
        const double shift = double((7 * program.rank + 3 * static_cast<int>(seed)) % 5);
        for (std::size_t i = 0; i < program.coordinates.size(); i += 2) {
            program.coordinates[i] += 0.3 * shift;
        }
        program.set({{"RRCB_REFINE", "EXACT"}, {"RETURN_LISTS", "PARTS"}});
        EXPECT_LE(moved_with(program, "RRCB", "1"), moved_with(program, "RCB", "1") + 0.02) << seed;
    }
}

TEST(Remap, finds_objects_by_the_new_numbers) {
    Rotated program;
    program.set({{"LB_METHOD", "RRCB"}, {"KEEP_CUTS", "1"}});
    const std::vector<int> parts = parts_by_object(program.partition());
    for (std::size_t i = 0; i < parts.size(); ++i) expect_found(program, i, parts[i], parts[i]);
}

TEST(Remap, keeps_the_numbers_of_parts_that_callbacks_name) {
    Program program(1);
    // Two groups on every rank, which callbacks name the wrong way round: 1, 0, 3, 2, ...
    for (int i = 0; i < 20; ++i) program.add({2.0 * program.rank + (i % 2)});
    ZOLTAN_PART_FN* part = [](void* data, int, int, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR lid, int* code) {
        *code = ZOLTAN_OK;
        return 2 * static_cast<Program*>(data)->rank + 1 - static_cast<int>(*lid % 2);
    };
    Zoltan_Set_Part_Fn(program.zz, part, &program);
    program.set("NUM_GLOBAL_PARTS", std::to_string(2 * program.num_ranks));
    for (const char* method : {"RCB", "RRCB"}) {
        program.set({{"LB_METHOD", method}, {"REMAP", "0"}});
        EXPECT_EQ(program.partition().changes, 1) << method;
        program.set("REMAP", "1");
        EXPECT_EQ(program.partition().changes, 0) << method;
    }
}

TEST(Remap, leaves_parts_of_different_sizes_and_parts_on_several_ranks) {
    Rotated program;
    program.set({{"LB_METHOD", "RRCB"}, {"NUM_GLOBAL_PARTS", "2"}});
    program.set_size(0, 3);
    const Outcome sized = program.partition();
    program.set("REMAP", "0");
    EXPECT_EQ(sized.exports.parts, program.partition().exports.parts);
}

/// With as many parts as this, work or memory in their square does not end within the time-out.
struct ManyParts : Program {
    static constexpr int num_parts = 50000;
    ManyParts() {
        scatter_points(*this, 2 * num_parts / num_ranks);
        set({{"LB_METHOD", "RRCB"}, {"NUM_GLOBAL_PARTS", std::to_string(num_parts)}});
        set("RETURN_LISTS", "PARTS");
    }
};

TEST(Remap, of_many_parts_keeps_more_objects_on_their_rank) {
    ManyParts program;
    const double without = moved_with(program, "RRCB", "0");
    const double with = moved_with(program, "RRCB", "1");
    if (program.num_ranks == 1) {
        EXPECT_EQ(with, 0);
    } else {
        EXPECT_LT(with, without - 0.05);
    }
}

TEST(Remap, of_many_parts_has_regions_that_hold_their_objects) {
    ManyParts program;
    program.set("KEEP_CUTS", "1");
    const std::vector<int> parts = parts_by_object(program.partition());
    for (int part = 0; part < ManyParts::num_parts; ++part)
        ASSERT_EQ(region_of(program.zz, part).code, ZOLTAN_OK);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Region region = region_of(program.zz, parts[i]);
        for (std::size_t a = 0; a < 2; ++a) {
            ASSERT_LE(region.lower[a], program.coordinates[2 * i + a]);
            ASSERT_GE(region.upper[a], program.coordinates[2 * i + a]);
        }
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
