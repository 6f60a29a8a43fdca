#include "program.hpp"
#include "regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace rrcb::zoltan_test {
namespace {

using Direction = std::array<double, 3>;

/// Three directions at right angles to each other and at a slant to the coordinate axes.
constexpr std::array<Direction, 3> slanted = {
    {{2.0 / 3, 2.0 / 3, 1.0 / 3}, {-2.0 / 3, 1.0 / 3, 2.0 / 3}, {1.0 / 3, -2.0 / 3, 2.0 / 3}}};
constexpr std::array<Direction, 3> upright = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<Direction, 3> slanted_in_the_plane = {{{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {}}};

/// A box full of points, with these extents along these directions.
struct Cloud {
    int dimension;
    std::array<double, 3> extents;
    std::array<Direction, 3> directions;
    double offset = 0;
};

double along(const Direction& direction, const double* position, int dimension) {
    double sum = 0;
    for (int j = 0; j < dimension; ++j) sum += direction[std::size_t(j)] * position[j];
    return sum;
}

void fill(Program& program, const Cloud& cloud, int count) {
    scatter_points(program, count);
    std::ranges::fill(program.weights, 1.0F);
    for (int i = 0; i < program.size(); ++i) {
        double* position = program.coordinates.data() + i * cloud.dimension;
        const std::array<double, 3> inside = {position[0], position[1],
                                              cloud.dimension == 3 ? position[2] : 0};
        for (int j = 0; j < cloud.dimension; ++j) {
            position[j] = 0;
            for (std::size_t k = 0; k < std::size_t(cloud.dimension); ++k)
                position[j] +=
                    cloud.extents[k] * cloud.directions[k][std::size_t(j)] * (inside[k] - 0.5);
            position[j] += cloud.offset;
        }
    }
}

int part_at(Program& program, const std::vector<double>& position) {
    int rank = -1;
    int part = -1;
    std::vector<double> copy = position;
    copy.resize(3);
    EXPECT_EQ(Zoltan_LB_Point_PP_Assign(program.zz, copy.data(), &rank, &part), ZOLTAN_OK);
    return part;
}

std::vector<double> position_of(const Program& program, int i) {
    const auto first = program.coordinates.begin() + i * program.dimension;
    return {first, first + program.dimension};
}

/// Along how many directions of the cloud a position may move far without change of its part, and
/// how many are left: those in which the cloud was cut.
int dimensions_cut(Program& program, const Cloud& cloud) {
    int cut = 0;
    for (std::size_t k = 0; k < std::size_t(cloud.dimension); ++k) {
        std::array<int, 2> changed{0, program.size()};
        for (int i = 0; i < program.size(); ++i) {
            std::vector<double> position = position_of(program, i);
            const int before = part_at(program, position);
            for (std::size_t j = 0; j < position.size(); ++j)
                position[j] += (i % 2 == 0 ? 1 : -1) * cloud.extents[0] * cloud.directions[k][j];
            changed[0] += part_at(program, position) != before;
        }
        MPI_Allreduce(MPI_IN_PLACE, changed.data(), 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        if (5 * changed[0] > changed[1]) ++cut;
    }
    return cut;
}

void ask_for_flat(Program& program, const char* method, int num_parts) {
    program.set("LB_METHOD", method);
    program.set("REDUCE_DIMENSIONS", "1");
    program.set("KEEP_CUTS", "1");
    program.set("RETURN_LISTS", "PARTS");
    program.set("REMAP", "0");
    program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
    if (std::string(method) == "RRCB") program.set("RRCB_REFINE", "EXACT");
}

/// The look-ups find every object in its part, and a box around it touches that part.
void expect_lookups_agree(Program& program, const std::vector<int>& parts, double size,
                          int num_parts) {
    int misplaced = 0;
    int missed = 0;
    std::vector<int> ranks(std::size_t(program.num_ranks));
    std::vector<int> touched(static_cast<std::size_t>(num_parts));
    for (int i = 0; i < program.size(); ++i) {
        const int part = parts[std::size_t(i)];
        std::vector<double> at = position_of(program, i);
        misplaced += part_at(program, at) != part;
        at.resize(3);
        int num_ranks = 0;
        int num_touched = 0;
        // Around the object, the object at a corner, the object alone.
        for (const std::array<double, 2> reach : {std::array{size, size}, {0, size}, {0, 0}}) {
            EXPECT_EQ(Zoltan_LB_Box_PP_Assign(program.zz, at[0] - reach[0], at[1] - reach[0],
                                              at[2] - reach[0], at[0] + reach[1], at[1] + reach[1],
                                              at[2] + reach[1], ranks.data(), &num_ranks,
                                              touched.data(), &num_touched),
                      ZOLTAN_OK);
            missed += std::find(touched.data(), touched.data() + num_touched, part) ==
                      touched.data() + num_touched;
        }
    }
    EXPECT_EQ(misplaced, 0);
    EXPECT_EQ(missed, 0);
}

/// Sum over the parts of their extents along the directions of the cloud: what they have of skin.
double skin(const Program& program, const std::vector<int>& parts, const Cloud& cloud,
            int num_parts) {
    const std::size_t dimension = std::size_t(cloud.dimension);
    std::vector<double> ends(2 * dimension * std::size_t(num_parts), -1e300);
    for (int i = 0; i < program.size(); ++i) {
        for (std::size_t k = 0; k < dimension; ++k) {
            const std::size_t at = 2 * (std::size_t(parts[std::size_t(i)]) * dimension + k);
            const double x =
                along(cloud.directions[k], program.coordinates.data() + i * cloud.dimension,
                      cloud.dimension);
            ends[at] = std::max(ends[at], x);
            ends[at + 1] = std::max(ends[at + 1], -x);
        }
    }
    MPI_Allreduce(MPI_IN_PLACE, ends.data(), int(ends.size()), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return std::accumulate(ends.begin(), ends.end(), 0.0);
}

constexpr int num_parts = 8;

struct Decision {
    const char* name;
    Cloud cloud;
    const char* ratio;
    int expected;             ///< dimensions left
    bool seen_by_rcb = true;  ///< its axes of an exact line are at fault
};

const std::array decisions = {
    Decision{"slanted plate", {3, {4, 3, 0.1}, slanted}, "10", 2},
    Decision{"slanted rod", {3, {4, 0.1, 0.05}, slanted}, "10", 1},
    Decision{"slanted block", {3, {4, 3, 2}, slanted}, "10", 3},
    Decision{"a little thinner than the ratio", {3, {4, 3, 0.37}, slanted}, "10", 2},
    Decision{"a little thicker than the ratio", {3, {4, 3, 0.43}, slanted}, "10", 3},
    Decision{"block at a small ratio", {3, {4, 3, 1}, slanted}, "2", 2},
    Decision{"ratio that makes no sense", {3, {4, 3, 2}, slanted}, "0.5", 3},
    Decision{"upright plate", {3, {4, 3, 0.1}, upright, 10}, "10", 2},
    Decision{"upright rod", {3, {4, 0.1, 0.05}, upright, 10}, "10", 1},
    Decision{"plane that was drawn out", {3, {4, 3, 0}, slanted}, "10", 2},
    Decision{"line", {3, {4, 0, 0}, slanted}, "10", 1, false},
    Decision{"strip in the plane", {2, {4, 0.1, 0}, slanted_in_the_plane}, "10", 1},
    Decision{"sheet in the plane", {2, {4, 3, 0}, slanted_in_the_plane}, "10", 2},
};

TEST(ReduceDimensions, decides_as_rcb_does_and_balances_as_well) {
    for (const Decision& decision : decisions) {
        SCOPED_TRACE(decision.name);
        std::array<double, 2> skins{};
        for (const bool ours : {false, true}) {
            SCOPED_TRACE(ours ? "RRCB" : "RCB");
            Program program(decision.cloud.dimension);
            fill(program, decision.cloud, 1200 / program.num_ranks);
            ask_for_flat(program, ours ? "RRCB" : "RCB", num_parts);
            program.set("DEGENERATE_RATIO", decision.ratio);
            const Outcome outcome = program.partition();
            EXPECT_EQ(outcome.code, ZOLTAN_OK);
            const int cut = dimensions_cut(program, decision.cloud);
            EXPECT_EQ(cut, ours || decision.seen_by_rcb ? decision.expected : cut);
            const std::vector<int> parts = parts_by_object(outcome);
            skins[ours] = skin(program, parts, decision.cloud, num_parts);
            if (!ours) continue;
            EXPECT_LE(imbalance(program, outcome, num_parts), 1 + 8.0 / 1200 + 1e-9);
            expect_lookups_agree(program, parts, 0.05, num_parts);
        }
        EXPECT_LT(skins[1], 1.1 * skins[0]);
    }
}

TEST(ReduceDimensions, survives_clouds_of_any_size_and_place) {
    struct Case {
        double extent, offset;
        int expected;
    };
    for (const Case size : {Case{1e-3, 1e9, 2}, {1e300, 0, 2}, {1e-300, 0, 2}, {0, 5, 3}}) {
        SCOPED_TRACE(size.extent);
        const double e = size.extent;
        const Cloud cloud{3, {4 * e, 3 * e, 0.01 * e}, slanted, size.offset};
        Program program(3);
        fill(program, cloud, 300);
        ask_for_flat(program, "RRCB", 4);
        const Outcome outcome = program.partition();
        EXPECT_GE(outcome.code, 0);
        if (e == 0) continue;
        EXPECT_EQ(dimensions_cut(program, cloud), size.expected);
        EXPECT_LE(imbalance(program, outcome, 4), 1.02);
        expect_lookups_agree(program, parts_by_object(outcome), e / 100, 4);
    }
}

TEST(ReduceDimensions, survives_few_objects_and_zero_weights) {
    for (int count = 0; count < 5; ++count) {
        for (const int dimension : {1, 2, 3}) {
            Program program(dimension);
            if (program.rank == 0)
                for (int i = 0; i < count; ++i)
                    program.add(std::vector<double>(std::size_t(dimension), i), 0);
            ask_for_flat(program, "RRCB", 3);
            program.set("OBJ_WEIGHT_DIM", "1");
            const Outcome outcome = program.partition();
            EXPECT_GE(outcome.code, 0) << count << " objects in " << dimension << "-D";
            const std::vector<int> parts = parts_by_object(outcome);
            for (int i = 0; i < program.size(); ++i)
                EXPECT_EQ(part_at(program, position_of(program, i)), parts[std::size_t(i)]);
        }
    }
}

TEST(ReduceDimensions, names_a_coordinate_that_is_no_number) {
    Program program(3);
    fill(program, decisions[0].cloud, 50);
    if (program.rank == program.num_ranks - 1) program.coordinates[7] = std::nan("");
    ask_for_flat(program, "RRCB", 2);
    EXPECT_EQ(program.partition().code, ZOLTAN_FATAL);
    program.coordinates[7] = 0;
    EXPECT_EQ(program.partition().code, ZOLTAN_OK);
}

TEST(ReduceDimensions, tells_boxes_along_the_axes_of_the_cloud) {
    std::array<double, 2> planes{};
    for (const bool ours : {false, true}) {
        const Cloud cloud{3, {4, 3, 0.01}, slanted, 100};
        Program program(3);
        fill(program, cloud, 1200 / program.num_ranks);
        ask_for_flat(program, ours ? "RRCB" : "RCB", 2);
        program.partition();
        const Region lower = region_of(program.zz, 0);
        EXPECT_EQ(lower.dimension, 3);
        EXPECT_EQ(planes_per_axis(program, 2), (std::array{1, 0, 0}));
        planes[ours] = std::abs(lower.upper[0]);  // an axis has no sign
    }
    // From the origin of the coordinates; both lie between the same two objects.
    EXPECT_NEAR(planes[1], planes[0], 0.02);
    EXPECT_GT(planes[0], 150);
}

TEST(ReduceDimensions, keeps_its_axes_and_cuts_from_call_to_call) {
    for (const char* parameter : {"KEEP_CUTS", "RCB_REUSE", "RCB_LOCK_DIRECTIONS"}) {
        SCOPED_TRACE(parameter);
        const Cloud& cloud = decisions[0].cloud;
        Program program(3);
        fill(program, cloud, 1200 / program.num_ranks);
        ask_for_flat(program, "RRCB", num_parts);
        program.set(parameter, "1");
        program.partition();
        const Region before = region_of(program.zz, 0);
        for (std::size_t i = 0; i < program.coordinates.size(); ++i)
            program.coordinates[i] *= 1 + 1e-4 * double(i % 7);
        const Outcome outcome = program.partition();
        EXPECT_LE(imbalance(program, outcome, num_parts), 1 + 8.0 / 1200 + 1e-9);
        expect_lookups_agree(program, parts_by_object(outcome), 0.05, num_parts);
        EXPECT_NEAR(region_of(program.zz, 0).upper[0], before.upper[0], 0.01);
        // A block instead, and a plate in another direction.
        for (double& x : program.coordinates) x = std::fmod(std::abs(x) * 1e4, 1.0);
        expect_lookups_agree(program, parts_by_object(program.partition()), 0.05, num_parts);
        for (std::size_t i = 0; i < program.coordinates.size(); i += 3)
            program.coordinates[i] *= 1e-3;
        expect_lookups_agree(program, parts_by_object(program.partition()), 0.05, num_parts);
    }
}

TEST(ReduceDimensions, goes_with_copies_and_buffers) {
    Program program(3);
    fill(program, decisions[0].cloud, 600);
    ask_for_flat(program, "RRCB", num_parts);
    const std::vector<int> parts = parts_by_object(program.partition());
    Zoltan_Struct* copy = Zoltan_Copy(program.zz);
    std::vector<char> buffer(Zoltan_Serialize_Size(program.zz));
    ASSERT_EQ(Zoltan_Serialize(program.zz, buffer.size(), buffer.data()), ZOLTAN_OK);
    Zoltan_Struct* filled = Zoltan_Create(MPI_COMM_WORLD);
    ASSERT_EQ(Zoltan_Deserialize(filled, buffer.size(), buffer.data()), ZOLTAN_OK);
    for (Zoltan_Struct* other : {copy, filled}) {
        for (int i = 0; i < program.size(); ++i) {
            int rank = -1;
            int part = -1;
            double* at = program.coordinates.data() + 3 * i;
            ASSERT_EQ(Zoltan_LB_Point_PP_Assign(other, at, &rank, &part), ZOLTAN_OK);
            ASSERT_EQ(part, parts[std::size_t(i)]);
        }
    }
    Zoltan_Destroy(&copy);
    Zoltan_Destroy(&filled);
}

TEST(ReduceDimensions, has_the_same_bits_again) {
    std::array<Region, 2> regions;
    for (Region& region : regions) {
        Program program(3);
        fill(program, decisions[0].cloud, 500);
        ask_for_flat(program, "RRCB", num_parts);
        program.partition();
        region = region_of(program.zz, 3);
    }
    EXPECT_EQ(regions[0].lower, regions[1].lower);
    EXPECT_EQ(regions[0].upper, regions[1].upper);
    std::array<double, 3> first = regions[0].lower;
    MPI_Bcast(first.data(), 3, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    EXPECT_EQ(first, regions[0].lower);
}

}  // namespace
}  // namespace rrcb::zoltan_test
