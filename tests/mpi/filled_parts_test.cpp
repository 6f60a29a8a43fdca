// Parts that stay empty although there are points for all of them.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>

namespace rrcb {
namespace {

/// Points of this rank with weights of which some exceed a part.
struct SkewedPoints {
    std::vector<double> coordinates, weights;

    SkewedPoints(std::mt19937_64& engine, int count, bool is_power) {
        weights.reserve(1);
        for (int i = 0; i < count; ++i) {
            const double x = test::uniform(engine);
            const double y = test::uniform(engine);
            const double u = test::uniform(engine, 1e-6);
            const double heavy = u < 0.1 ? 20 : 1;
            if (i % num_ranks() != rank()) continue;
            coordinates.insert(coordinates.end(), {x, y});
            weights.push_back(is_power ? std::pow(u, -0.7) : heavy);
        }
    }

    Points points() const { return Points(coordinates, 2, weights); }
};

auto num_empty(const Balance& result) {
    return std::ranges::count(result.report.part_weights, 0.0);
}

TEST(Parts, are_filled_whatever_the_weights) {
    std::mt19937_64 engine(9);
    for (int round = 0; round < 120; ++round) {
        Options options{.num_parts = 2 + static_cast<int>(engine() % 30),
                        .refine = round % 3 == 0 ? Refine::exact : Refine::tolerance,
                        .expert = {.max_root_parts = round % 5 == 0 ? 2 : 4096}};
        const bool is_power = round % 2 == 0;
        const SkewedPoints skewed(engine, (is_power ? 20 : 5) * options.num_parts, is_power);
        const Balance result = balance(skewed.points(), MPI_COMM_WORLD, options);
        EXPECT_EQ(num_empty(result), 0) << "round " << round;
    }
}

TEST(Parts, are_filled_within_a_wide_tolerance) {
    std::mt19937_64 engine(9);
    for (int round = 0; round < 60; ++round) {
        Options options{.num_parts = 2 + static_cast<int>(engine() % 30),
                        .imbalance_tolerance = 1.5};
        SkewedPoints points(engine, 2 * options.num_parts, false);
        std::ranges::fill(points.weights, 1.0);
        const Balance result = balance(points.points(), MPI_COMM_WORLD, options);
        EXPECT_EQ(num_empty(result), 0) << "round " << round;
        EXPECT_TRUE(result.report.within_tolerance);
    }
}

TEST(Parts, of_different_sizes_may_stay_empty) {
    // 3 and 0 exceed the shares by 1.18, 2 and 1 by 2.17.
    std::vector<double> x;
    if (rank() == 0) x = {0, 1, 2};
    for (const Refine refine : {Refine::tolerance, Refine::exact}) {
        Options options{.num_parts = 2, .part_sizes = {0.8466, 0.1534}, .refine = refine};
        const Balance result = balance(Points(x, 1), MPI_COMM_WORLD, options);
        EXPECT_EQ(result.report.part_weights, (std::vector<double>{3, 0}));
    }
}

}  // namespace
}  // namespace rrcb
