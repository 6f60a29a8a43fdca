#include "program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace rrcb::zoltan_test {
namespace {

/// Objects of all ranks whose point look-up, or box look-up of a box of no size, does not find the
/// part that the partition gave them.
struct Disagreements {
    long points = 0, boxes = 0, objects = 0;
};

Disagreements disagreements(Program& program, const char* method, int num_parts) {
    program.set("LB_METHOD", method);
    program.set("KEEP_CUTS", "1");
    program.set("RETURN_LISTS", "PARTS");
    program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    const std::vector<int> parts = parts_by_object(program.partition());
    std::vector<int> found(static_cast<std::size_t>(num_parts));
    std::vector<int> ranks(static_cast<std::size_t>(program.num_ranks));
    std::array<long, 3> counts{};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto stride = static_cast<std::size_t>(program.dimension);
        double x[3] = {0, 0, 0};
        std::copy_n(&program.coordinates[i * stride], stride, x);
        int rank = -1, part = -1, num_found = 0, num_ranks = 0;
        Zoltan_LB_Point_PP_Assign(program.zz, x, &rank, &part);
        Zoltan_LB_Box_PP_Assign(program.zz, x[0], x[1], x[2], x[0], x[1], x[2], ranks.data(),
                                &num_ranks, found.data(), &num_found);
        counts[0] += part != parts[i];
        counts[1] += std::find(found.begin(), found.begin() + num_found, parts[i]) ==
                     found.begin() + num_found;
        ++counts[2];
    }
    MPI_Allreduce(MPI_IN_PLACE, counts.data(), 3, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
    return {counts[0], counts[1], counts[2]};
}

/// Points of a lattice of `side` per axis, dealt out to the ranks.
void fill_lattice(Program& program, int side) {
    const int count = static_cast<int>(std::lround(std::pow(side, program.dimension)));
    for (int i = program.rank; i < count; i += program.num_ranks) {
        std::vector<double> position;
        for (int a = 0, rest = i; a < program.dimension; ++a, rest /= side) {
            position.push_back(0.25 * (rest % side));
        }
        program.add(std::move(position));
    }
}

void compare(const char* name, Program& program, int num_parts) {
    for (const char* method : {"RCB", "RRCB"}) {
        const Disagreements found = disagreements(program, method, num_parts);
        if (program.rank == 0) {
            std::printf("%-22s %2d parts %-4s wrong: %6ld points, %6ld boxes of %ld\n", name,
                        num_parts, method, found.points, found.boxes, found.objects);
        }
        if (std::string(method) == "RCB") continue;
        EXPECT_EQ(found.points, 0) << name;
        EXPECT_EQ(found.boxes, 0) << name;
    }
}

TEST(LookUps, find_every_object_of_a_lattice_where_the_partition_put_it) {
    for (const int num_parts : {2, 7, 16}) {
        Program line(1), plane(2), space(3);
        fill_lattice(line, 101);
        fill_lattice(plane, 31);
        fill_lattice(space, 11);
        compare("line of 101", line, num_parts);
        compare("lattice of 31 x 31", plane, num_parts);
        compare("lattice of 11^3", space, num_parts);
    }
}

TEST(LookUps, find_every_object_on_the_cuts) {
    // A new handle each: on one whose parts become more Zoltan writes behind the end of its tree.
    for (const int num_parts : {2, 4, 9}) {
        // Three out of four points lie on the planes that halve and quarter the square.
        Program program;
        scatter_points(program, 600);
        for (std::size_t i = 0; i < program.coordinates.size(); i += 2) {
            if (i % 8 < 4) program.coordinates[i] = 0.5;
            if (i % 8 > 2) program.coordinates[i + 1] = i % 8 == 4 ? 0.25 : 0.75;
        }
        compare("points on planes", program, num_parts);
    }
}

}  // namespace
}  // namespace rrcb::zoltan_test
