#include "program.hpp"
#include "regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

namespace rrcb::zoltan_test {
namespace {

/// How the weights of an object hang together, and where they lie.
enum class Kind { correlated, opposed, in_corners, heavy_tailed };
constexpr std::array kinds = {Kind::correlated, Kind::opposed, Kind::in_corners,
                              Kind::heavy_tailed};

/// Objects in a box with up to four weights each.
struct Weighted : Program {
    Weighted(Kind kind, int dimension_, int num_weights, unsigned seed, int count)
        : Program(dimension_) {
        std::mt19937 random(seed + 1000 * static_cast<unsigned>(rank));
        std::uniform_real_distribution<double> uniform(0, 1);
        for (int i = 0; i < count; ++i) {
            std::vector<double> at;
            for (int a = 0; a < dimension; ++a) at.push_back(uniform(random) * (1 + (a == 0)));
            std::array<float, 4> mine{};
            const double common = uniform(random);
            for (int k = 0; k < 4; ++k) {
                const double x = at[std::size_t(k / 2 % dimension)];
                double weight = 1;
                if (kind == Kind::correlated) weight = 0.5 + common + 0.2 * uniform(random);
                if (kind == Kind::opposed) weight = k % 2 == 0 ? x : (k / 2 == 0 ? 2 : 1) - x;
                if (kind == Kind::in_corners) {
                    double far = 0;
                    for (int a = 0; a < dimension; ++a) {
                        const double corner = (k >> (a % 2)) % 2;
                        far += std::pow(at[std::size_t(a)] / (1 + (a == 0)) - corner, 2);
                    }
                    weight = std::exp(-8 * far);
                }
                if (kind == Kind::heavy_tailed) weight = std::pow(uniform(random) + 1e-3, -0.7);
                mine[std::size_t(k)] = static_cast<float>(weight);
            }
            add(at, mine[0]);
            further.push_back(mine);
        }
        further_weight = [this](int object, int k) {
            return further[std::size_t(object)][std::size_t(k)];
        };
        set("OBJ_WEIGHT_DIM", std::to_string(num_weights));
        set("RETURN_LISTS", "PARTS");
        set("REMAP", "0");
    }

    std::vector<std::array<float, 4>> further;
};

/// Heaviest part over mean part, of the weight that is worst.
double worst_imbalance(const Weighted& program, const Outcome& outcome, int num_weights,
                       int num_parts) {
    std::vector<double> sums(std::size_t(num_weights * num_parts));
    const std::vector<int> parts = parts_by_object(outcome);
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (int k = 0; k < num_weights; ++k)
            sums[std::size_t(k * num_parts + parts[i])] +=
                static_cast<double>(program.further_weight(int(i), k));
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), int(sums.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    double worst = 0;
    for (int k = 0; k < num_weights; ++k) {
        const auto first = sums.begin() + k * num_parts;
        double total = 0;
        for (int p = 0; p < num_parts; ++p) total += first[p];
        worst = std::max(worst, *std::max_element(first, first + num_parts) * num_parts / total);
    }
    return worst;
}

/// Worst imbalances of a cloud under RCB and under RRCB.
std::array<double, 2> compare(Kind kind, int norm, int num_weights, int num_parts) {
    std::array<double, 2> worst{};
    for (const bool ours : {false, true}) {
        int num_ranks = 1;
        MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
        Weighted program(kind, 2 + num_parts % 2, num_weights,
                         unsigned(7 * num_parts + num_weights), 2000 / num_ranks);
        program.set("LB_METHOD", ours ? "RRCB" : "RCB");
        program.set("RCB_MULTICRITERIA_NORM", std::to_string(norm));
        program.set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
        const Outcome outcome = program.partition();
        EXPECT_EQ(outcome.code, ZOLTAN_OK);
        worst[ours] = worst_imbalance(program, outcome, num_weights, num_parts);
    }
    return worst;
}

TEST(Norms, balance_the_worst_weight_no_worse_than_rcb) {
    for (const int norm : {1, 2, 3}) {
        std::array<double, 2> sum{};
        double worst_ratio = 0;
        int count = 0;
        int num_worse = 0;
        for (const Kind kind : kinds) {
            for (int num_weights = 2; num_weights <= 4; ++num_weights) {
                for (const int num_parts : {3, 6, 16}) {
                    const auto worst = compare(kind, norm, num_weights, num_parts);
                    for (std::size_t m = 0; m < 2; ++m) sum[m] += worst[m];
                    worst_ratio = std::max(worst_ratio, worst[1] / worst[0]);
                    num_worse += worst[1] > 1.07 * worst[0];
                    ++count;
                }
            }
        }
        int rank = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        if (rank == 0)
            std::printf(
                "norm %d: worst imbalance in the mean RCB %.4f, RRCB %.4f; at most %.3f "
                "times RCB's\n",
                norm, sum[0] / count, sum[1] / count, worst_ratio);
        EXPECT_LE(sum[1], sum[0]);
        // Both choose cut by cut, and now and then the other is lucky: 1.39 times, seen with 16
        // parts of weights in three corners on 5 ranks, where RCB divides 2 to 3 first.
        EXPECT_LE(num_worse, 2);
        EXPECT_LT(worst_ratio, 1.45);
    }
}

/// Two weights that lie on opposite sides, in `num_parts` parts by norm 3.
struct Opposed : Weighted {
    explicit Opposed(int num_parts) : Weighted(Kind::opposed, 2, 2, 3, 600) {
        set("LB_METHOD", "RRCB");
        set("RCB_MULTICRITERIA_NORM", "3");
        set("NUM_GLOBAL_PARTS", std::to_string(num_parts));
        set("KEEP_CUTS", "1");
    }
};

void expect_parts_where_objects_are(Program& program, const Outcome& outcome) {
    const std::vector<int> parts = parts_by_object(outcome);
    ASSERT_EQ(int(parts.size()), program.size());
    for (int i = 0; i < program.size(); ++i) {
        int rank = -1;
        int part = -1;
        double* at = program.coordinates.data() + i * program.dimension;
        ASSERT_EQ(Zoltan_LB_Point_PP_Assign(program.zz, at, &rank, &part), ZOLTAN_OK);
        ASSERT_EQ(part, parts[std::size_t(i)]);
    }
}

TEST(Norms, are_found_again_by_look_ups_copies_and_the_next_call) {
    for (const char* parameter : {"KEEP_CUTS", "REMAP", "RCB_REUSE", "RCB_LOCK_DIRECTIONS",
                                  "REDUCE_DIMENSIONS", "AVERAGE_CUTS"}) {
        SCOPED_TRACE(parameter);
        Opposed program(5);
        program.set(parameter, "1");
        const Outcome first = program.partition();
        expect_parts_where_objects_are(program, first);
        const Outcome second = program.partition();
        EXPECT_EQ(second.exports.parts, first.exports.parts);
        for (double& x : program.coordinates) x *= 1 + 0.1 * x;
        const Outcome third = program.partition();
        expect_parts_where_objects_are(program, third);
        EXPECT_LT(worst_imbalance(program, third, 2, 5), 1.6);
    }
}

TEST(Norms, keep_to_the_axes_that_are_asked_for) {
    Opposed program(4);
    for (std::size_t i = 1; i < program.coordinates.size(); i += 2) program.coordinates[i] *= 1.8;
    program.set("RCB_SET_DIRECTIONS", "4");
    program.partition();
    // One cut across y, then one across x on each side of it.
    EXPECT_EQ(planes_per_axis(program, 4), (std::array{2, 1, 0}));
}

TEST(Norms, do_not_cut_axes_that_are_too_short) {
    Opposed program(4);
    // Weights that lie opposite along x are best cut across y, the half as long.
    program.partition();
    EXPECT_EQ(planes_per_axis(program, 4)[0], 0);
    program.set("RCB_MAX_ASPECT_RATIO", "1.5");
    program.partition();
    EXPECT_GT(planes_per_axis(program, 4)[0], 0);
}

TEST(Norms, divide_planes_of_objects_or_keep_them_together) {
    for (const bool rectilinear : {false, true}) {
        Program program;
        for (int i = program.rank; i < 81; i += program.num_ranks)
            program.add({double(i % 9), double(i / 9)});
        program.further_weight = [](int, int) { return 2.0F; };
        program.set("LB_METHOD", "RRCB");
        program.set("OBJ_WEIGHT_DIM", "2");
        program.set("RCB_MULTICRITERIA_NORM", "2");
        program.set("RETURN_LISTS", "PARTS");
        program.set("NUM_GLOBAL_PARTS", "2");
        program.set("RCB_RECTILINEAR_BLOCKS", rectilinear ? "1" : "0");
        const Outcome outcome = program.partition();
        EXPECT_DOUBLE_EQ(imbalance(program, outcome, 2), (rectilinear ? 45 : 41) / 40.5);
    }
}

TEST(Norms, divide_objects_in_one_place_by_number_or_keep_them_together) {
    for (const bool together : {false, true}) {
        Program program;
        for (int i = 0; i < 60; ++i) program.add({3, 4}, float(1 + i % 2));
        program.further_weight = [](int i, int) { return float(1 + i % 3); };
        program.set("LB_METHOD", "RRCB");
        program.set("OBJ_WEIGHT_DIM", "2");
        program.set("RCB_MULTICRITERIA_NORM", "3");
        program.set("RETURN_LISTS", "PARTS");
        program.set("NUM_GLOBAL_PARTS", "4");
        if (together) program.set("RRCB_COINCIDENT", "TOGETHER");
        const double found = imbalance(program, program.partition(), 4);
        if (together) {
            EXPECT_EQ(found, 4);
        } else {
            EXPECT_LT(found, 1.1);
        }
    }
}

TEST(Norms, take_weights_that_are_zero_and_objects_that_are_few) {
    for (const int count : {0, 1, 2, 50}) {
        for (const bool all_zero : {false, true}) {
            Program program;
            if (program.rank == 0)
                for (int i = 0; i < count; ++i)
                    program.add({double(i), double(i * i % 7)}, all_zero ? 0 : 1);
            program.further_weight = [](int, int) { return 0.0F; };
            program.set("LB_METHOD", "RRCB");
            program.set("OBJ_WEIGHT_DIM", "3");
            program.set("RCB_MULTICRITERIA_NORM", "3");
            program.set("RETURN_LISTS", "PARTS");
            program.set("NUM_GLOBAL_PARTS", "5");
            const Outcome outcome = program.partition();
            EXPECT_GE(outcome.code, 0);
            std::array<int, 5> numbers{};
            for (const int part : parts_by_object(outcome)) ++numbers[std::size_t(part)];
            MPI_Allreduce(MPI_IN_PLACE, numbers.data(), 5, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
            EXPECT_EQ(*std::ranges::max_element(numbers), (count + 4) / 5);
        }
    }
}

TEST(Norms, give_each_weight_its_own_sizes_of_parts) {
    for (const char* method : {"RCB", "RRCB"}) {
        SCOPED_TRACE(method);
        // Two clouds: the one has the first weight, the other the second.
        Program program;
        scatter_points(program, 1000);
        std::ranges::fill(program.weights, 1.0F);
        std::vector<float> second(1000, 0.0F);
        for (std::size_t i = 0; i < second.size(); i += 2) {
            program.coordinates[2 * i] += 2;
            std::swap(program.weights[i], second[i]);
        }
        program.further_weight = [&](int i, int) { return second[std::size_t(i)]; };
        program.set("LB_METHOD", method);
        program.set("OBJ_WEIGHT_DIM", "2");
        program.set("RCB_MULTICRITERIA_NORM", "3");
        program.set("RCB_SET_DIRECTIONS", "1");
        program.set("RETURN_LISTS", "PARTS");
        program.set("REMAP", "0");
        program.set("NUM_GLOBAL_PARTS", "2");
        // All of the first weight below, all of the second above.
        std::array parts{0, 0, 1, 1};
        std::array weights{0, 1, 0, 1};
        std::array sizes{0.99F, 0.01F, 0.01F, 0.99F};
        ASSERT_EQ(
            Zoltan_LB_Set_Part_Sizes(program.zz, 1, 4, parts.data(), weights.data(), sizes.data()),
            ZOLTAN_OK);
        const Outcome outcome = program.partition();
        const std::vector<int> found = parts_by_object(outcome);
        int at_odds = 0;
        for (std::size_t i = 0; i < found.size(); ++i) at_odds += found[i] != int(i % 2 == 0);
        EXPECT_LE(at_odds, 25);
    }
}

TEST(Norms, that_differ_between_ranks_are_named) {
    Opposed program(2);
    if (program.rank == program.num_ranks - 1) program.set("RCB_MULTICRITERIA_NORM", "2");
    EXPECT_EQ(program.partition().code, program.num_ranks > 1 ? ZOLTAN_FATAL : ZOLTAN_OK);
}

}  // namespace
}  // namespace rrcb::zoltan_test
