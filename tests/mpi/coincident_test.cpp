#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

Options dividing(int num_parts, Refine refine = Refine::exact) {
    Options options{
        .num_parts = num_parts, .refine = refine, .expert = {.coincident = Coincident::divide}};
    return options;
}

/// Whether each cut below a node leaves the share of the parts below it, but for the heaviest
/// point.
bool are_cuts_within(std::span<const double> weights, double heaviest) {
    if (weights.size() == 1) return true;
    const auto lower = weights.first(weights.size() / 2);
    const auto upper = weights.subspan(weights.size() / 2);
    const double below = std::accumulate(lower.begin(), lower.end(), 0.0);
    const double all = below + std::accumulate(upper.begin(), upper.end(), 0.0);
    const double target =
        all * static_cast<double>(lower.size()) / static_cast<double>(weights.size());
    const double slack = all >= heaviest ? heaviest : 1;
    return std::abs(below - target) <= slack * (1 + 1e-9) && are_cuts_within(lower, heaviest) &&
           are_cuts_within(upper, heaviest);
}

TEST(CoincidentPoints, beside_one_that_outweighs_them_are_divided_by_number) {
    constexpr LocalIndex count = 5;
    const std::vector<double> mine(count, 0.3);
    for (const int central_parts : {64, 2}) {
        for (const double heaviest : {50.0, 1e6}) {
            for (int num_parts = 3; num_parts < 16; ++num_parts) {
                std::vector<double> weights(count, 1.0);
                if (rank() == num_parts % num_ranks()) weights[count / 2] = heaviest;
                Options options = dividing(num_parts);
                options.expert.max_root_parts = central_parts;
                const Balance result = balance(Points(mine, 1, weights), MPI_COMM_WORLD, options);
                EXPECT_TRUE(are_cuts_within(
                    part_weights(Points(mine, 1, weights), result.parts, num_parts, MPI_COMM_WORLD),
                    heaviest))
                    << num_parts << " parts, " << heaviest << ", " << central_parts;
            }
        }
    }
}

TEST(CoincidentPoints, are_divided_as_distinct_ones_on_a_line) {
    std::mt19937_64 engine(11);
    for (int round = 0; round < 400; ++round) {
        Options options = dividing(2 + static_cast<int>(engine() % 12));
        options.expert.max_root_parts = engine() % 2 == 0 ? 2 : 4096;
        if (engine() % 3 != 0)
            for (int k = 0; k < options.num_parts; ++k)
                options.part_sizes.push_back(test::uniform(engine, 0.05));
        if (engine() % 3 == 0)
            options.expert.tree = {1 + static_cast<int>(engine() % 3), engine() % 2 == 0};
        // The row over the ranks is in ascending order.
        std::vector<double> apart(std::mt19937_64(engine() + rank())() % 100);
        std::iota(apart.begin(), apart.end(), 100.0 * rank());
        const std::vector<double> together(apart.size(), 0.5);
        const auto weights_of = [&](const std::vector<double>& x) {
            return balance(Points(x, 1), MPI_COMM_WORLD, options).report.part_weights;
        };
        ASSERT_EQ(weights_of(together), weights_of(apart)) << "round " << round;
    }
}

TEST(CoincidentPoints, go_to_the_side_that_they_make_less_too_heavy) {
    // 190 of 225 leave 35 for 34.515, which is 1.4 % more; 191 for 190.485 are 0.3 % more.
    std::vector<double> mine;
    for (int i = 0; i < 225; ++i)
        if (i % num_ranks() == rank()) mine.push_back(7);
    for (const Refine refine : {Refine::tolerance, Refine::exact}) {
        Options options = dividing(2, refine);
        options.part_sizes = {0.8466, 0.1534};
        const Balance result = balance(Points(mine, 1), MPI_COMM_WORLD, options);
        EXPECT_EQ(result.report.part_weights, (std::vector<double>{191, 34}));
        EXPECT_TRUE(result.report.within_tolerance);
    }
}

TEST(CoincidentPoints, stay_together_where_the_tolerance_allows_it) {
    // 490, 20 and 490: with either side of 510 the imbalance is 1.02.
    std::vector<double> mine;
    for (int i = 0; i < 1000; ++i)
        if (i % num_ranks() == rank()) mine.push_back(i < 490 ? i : i < 510 ? 5000 : 9000 + i);
    const Points points(mine, 1);
    for (const auto& [tolerance, together] : {std::pair{1.03, true}, std::pair{1.01, false}}) {
        Options options = dividing(2, Refine::tolerance);
        options.imbalance_tolerance = tolerance;
        options.expert.cells_per_axis = 1;
        const Balance result = balance(points, MPI_COMM_WORLD, options);
        EXPECT_LE(result.report.imbalance, tolerance);
        int places = 0;
        for (LocalIndex i = 0; i < points.count; ++i)
            if (mine[i] == 5000) places |= 1 << result.parts[i];
        MPI_Allreduce(MPI_IN_PLACE, &places, 1, MPI_INT, MPI_BOR, MPI_COMM_WORLD);
        EXPECT_EQ(places != 3, together);
    }
}

TEST(CoincidentPoints, on_a_plain_cut_stay_together) {
    const std::vector<double> mine(600, 0.7);
    Options options = dividing(4);
    options.expert.axes.plain = true;
    const Balance result = balance(Points(mine, 3), MPI_COMM_WORLD, options);
    for (const Part part : result.parts) EXPECT_EQ(part, result.parts[0]);
}

TEST(CoincidentPoints, at_rest_keep_their_parts_from_the_earlier_cuts) {
    // Whoever got a part holds it: lower ranks lower parts, so that the row over the ranks is
    // divided at the same places again.
    const int num_parts = num_ranks();
    const std::vector<double> mine(2 * 100, 0.25);
    const Points points(mine, 2);
    const Balance result = balance(points, MPI_COMM_WORLD, dividing(num_parts));
    for (const Part part : result.parts) EXPECT_EQ(part, rank());
}

}  // namespace
}  // namespace rrcb
