#include "program.hpp"
#include "regions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rrcb::zoltan_test {
namespace {

/// 240 objects in all, longest across x, which 2, 4 and 8 parts divide equally.
void fill(Program& program, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 240; ++i) {
        std::vector<double> position;
        for (int a = 0; a < program.dimension; ++a)
            position.push_back(std::pow(uniform(random), 3) * (a == 0 ? 4 : 1));
        if (i % program.num_ranks == program.rank) program.add(position);
    }
}

std::vector<Region> regions(Program& program, const char* method, int num_parts) {
    program.set("LB_METHOD", method);
    program.set("RRCB_REFINE", "EXACT");
    program.set("KEEP_CUTS", "1");
    program.set("REMAP", "0");
    program.set("RETURN_LISTS", "PARTS");
    program.set("AVERAGE_CUTS", "1");
    program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
    std::vector<Region> result;
    for (int part = 0; part < num_parts; ++part) result.push_back(region_of(program.zz, part));
    return result;
}

void expect_those_of_zoltan(int dimension, int num_parts) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(std::to_string(dimension) + "-D, " + std::to_string(num_parts) + " parts, " +
                     std::to_string(seed));
        Program program(dimension);
        fill(program, seed);
        const auto zoltans = regions(program, "RCB", num_parts);
        const auto ours = regions(program, "RRCB", num_parts);
        for (std::size_t part = 0; part < ours.size(); ++part) {
            EXPECT_EQ(ours[part].lower, zoltans[part].lower);
            EXPECT_EQ(ours[part].upper, zoltans[part].upper);
        }
    }
}

TEST(AverageCuts, are_those_of_zoltan_to_the_bit) {
    for (const int num_parts : {2, 4, 8}) expect_those_of_zoltan(1, num_parts);
    for (const int dimension : {2, 3}) expect_those_of_zoltan(dimension, 2);
}

/// Parts of the objects after a call, which look-ups must find again.
std::vector<int> parts_found_again(Program& program) {
    const std::vector<int> parts = parts_by_object(program.partition());
    const auto stride = static_cast<std::size_t>(program.dimension);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        int rank = -1, part = -1;
        Zoltan_LB_Point_PP_Assign(program.zz, &program.coordinates[i * stride], &rank, &part);
        EXPECT_EQ(part, parts[i]);
    }
    return parts;
}

TEST(AverageCuts, leave_every_object_in_its_part) {
    constexpr double tiny = 5e-324, huge = 1.7e308;
    for (const bool lattice : {false, true}) {
        for (const char* refine : {"AUTO", "EXACT", "NONE"}) {
            for (const int num_parts : {1, 2, 5, 16}) {
                Program program(2);
                if (lattice) {
                    for (int i = program.rank; i < 400; i += program.num_ranks)
                        program.add({double(i % 20), double(i / 20)});
                } else {
                    fill(program, 3);
                    // Neighbours without a number between them, and at both ends of the range; on
                    // one rank alone, or a cut might divide two of them in one place.
                    for (const auto& [x, y] : {std::pair{1.0, 1.0},
                                               {std::nextafter(1.0, 2.0), 1.0},
                                               {0.0, 0.0},
                                               {tiny, tiny},
                                               {huge, -huge},
                                               {-huge, huge}})
                        if (program.rank == 0) program.add({x, y});
                }
                program.set("LB_METHOD", "RRCB");
                program.set("RRCB_REFINE", refine);
                program.set("KEEP_CUTS", "1");
                program.set("RETURN_LISTS", "PARTS");
                program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
                const std::vector<int> parts = parts_found_again(program);
                program.set("AVERAGE_CUTS", "1");
                EXPECT_EQ(parts_found_again(program), parts);
            }
        }
    }
}

TEST(AverageCuts, that_differ_between_ranks_are_fatal) {
    Program program(2);
    if (program.num_ranks == 1) GTEST_SKIP() << "needs two ranks";
    fill(program, 1);
    program.set("LB_METHOD", "RRCB");
    program.set("AVERAGE_CUTS", program.rank == 0 ? "1" : "0");
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
}

}  // namespace
}  // namespace rrcb::zoltan_test
