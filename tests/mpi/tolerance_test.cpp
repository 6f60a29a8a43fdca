// Cuts to a tolerance: on any number of ranks, within the tolerance as counted point by point, and
// not dearer than exact ones.
#include "held_points.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

using test::HeldPoints;
using test::Share;

/// Clusters, the same for any number of ranks; every third rank holds none of them.
HeldPoints clusters(int dimension, unsigned seed, std::size_t count = 12000) {
    constexpr std::size_t num_clusters = 7;
    const auto d = static_cast<std::size_t>(dimension);
    const std::vector<double> centres = test::uniform_cloud(num_clusters, dimension, seed);
    std::mt19937_64 engine(seed + 50);
    HeldPoints all{dimension, {}};
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t centre = engine() % num_clusters;
        const double width = std::exp2(-1.0 * static_cast<double>(centre));
        for (std::size_t a = 0; a < d; ++a)
            all.coordinates.push_back(centres[centre * d + a] +
                                      width * (test::uniform(engine) + test::uniform(engine)));
        if (seed % 2 == 0) all.weights.push_back(std::exp2(test::uniform(engine, -10, 0)));
    }
    all.scatter();
    for (Part& owner : all.owners)
        if (owner % 3 == 2) owner = 0;
    return all;
}

/// What each part weighs, by looking up all points of all ranks.
std::vector<double> weights_by_look_up(const HeldPoints& all, const Cuts& cuts) {
    const Points points(all.coordinates, all.dimension, all.weights);
    std::vector<double> weights(static_cast<std::size_t>(cuts.num_parts));
    for (std::size_t i = 0; i < points.count; ++i)
        weights[static_cast<std::size_t>(part_of(cuts, points.position(i)))] += points.weight(i);
    return weights;
}

void expect_as_looked_up(const HeldPoints& all, const Points& mine, const Balance& result,
                         const std::vector<double>& sizes) {
    for (std::size_t i = 0; i < mine.count; ++i)
        ASSERT_EQ(result.parts[i], part_of(result.cuts, mine.position(i)));
    const std::vector<double> weights = weights_by_look_up(all, result.cuts);
    for (std::size_t p = 0; p < weights.size(); ++p)
        EXPECT_NEAR(result.report.part_weights[p], weights[p], 1e-9 * weights[p]);
    EXPECT_NEAR(result.report.imbalance, imbalance(weights, sizes), 1e-9);
}

Options with_parts(int num_parts, double tolerance) {
    Options options{.num_parts = num_parts, .imbalance_tolerance = tolerance};
    return options;
}

bool same_bits(const Balance& a, const Balance& b) {
    return a.parts == b.parts && a.report.part_weights == b.report.part_weights &&
           std::ranges::equal(a.cuts.tree, b.cuts.tree, [](const Cut& one, const Cut& other) {
               return one.axis == other.axis && one.at == other.at;
           });
}

/// The first count of the parts, which exact calls do not need, and a search that has missed.
constexpr int rounds_more_than_exact = 2;

TEST(Tolerance, takes_no_more_rounds_than_exact_cuts_but_for_the_first_counts) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const HeldPoints all = clusters(2 + static_cast<int>(seed % 2), seed);
        const Share mine(all);
        for (const int num_parts : {16, 64}) {
            Options exact = with_parts(num_parts, 1);
            exact.refine = Refine::exact;
            const Report of_exact = balance(mine.points(), MPI_COMM_WORLD, exact).report;
            for (const double tolerance : {1.1, 1.02, 1.003, 1.001}) {
                const Options options = with_parts(num_parts, tolerance);
                const Report report = balance(mine.points(), MPI_COMM_WORLD, options).report;
                EXPECT_LE(report.details.rounds, of_exact.details.rounds + rounds_more_than_exact)
                    << seed << ", " << num_parts << " parts to " << tolerance;
                EXPECT_LE(report.imbalance, std::max(tolerance, of_exact.imbalance));
            }
        }
    }
}

TEST(Tolerance, is_met_by_earlier_cuts_that_move_along) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        HeldPoints all = clusters(2 + static_cast<int>(seed % 2), seed);
        const Options options = with_parts(2 + static_cast<int>(seed), 1.02);
        const Share before(all);
        const Cuts first = balance(before.points(), MPI_COMM_WORLD, options).cuts;
        for (double& x : all.coordinates) x = std::pow(x + 1, 1.05);
        const Share mine(all);
        const Balance second = balance(mine.points(), MPI_COMM_WORLD, options, first);
        EXPECT_LE(second.report.imbalance, 1.02);
        expect_as_looked_up(all, mine.points(), second, options.part_sizes);
        EXPECT_TRUE(same_bits(second, balance(mine.points(), MPI_COMM_WORLD, options, first)));
    }
}

TEST(Tolerance, is_met_among_points_that_share_coordinates) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
        HeldPoints all = clusters(2, seed);
        all.weights.clear();
        for (std::size_t i = 0; i < all.coordinates.size(); ++i)
            if (i % 2 == 0) all.coordinates[i] = std::round(4 * all.coordinates[i]);
        const Share mine(all);
        Options options = with_parts(7, 1.01);
        const Balance result = balance(mine.points(), MPI_COMM_WORLD, options);
        EXPECT_LE(result.report.imbalance, 1.01);
        expect_as_looked_up(all, mine.points(), result, options.part_sizes);
        options.expert.axes.plain = true;
        const Balance plain = balance(mine.points(), MPI_COMM_WORLD, options);
        expect_as_looked_up(all, mine.points(), plain, options.part_sizes);
        for (const Cut& cut : plain.cuts.tree) EXPECT_EQ(cut.at[1 - cut.axis], -INFINITY);
    }
}

}  // namespace
}  // namespace rrcb
