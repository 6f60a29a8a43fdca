#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <cstdlib>

namespace rrcb {
namespace {

/// Objects of very different weight, dealt out to the ranks.
struct WeightedCloud {
    std::vector<double> coordinates;
    std::vector<double> weights;
    Options options;

    explicit WeightedCloud(unsigned seed) {
        std::mt19937_64 engine(seed);
        const auto count = 20 + engine() % 400;
        const double decades = static_cast<double>(engine() % 5);
        options.num_parts = 2 + static_cast<int>(engine() % 15);
        for (std::size_t i = 0; i < count; ++i) {
            const double x = test::uniform(engine);
            const double y = test::uniform(engine);
            const double weight = std::pow(10, decades * test::uniform(engine));
            if (i % static_cast<std::size_t>(num_ranks()) != static_cast<std::size_t>(rank()))
                continue;
            coordinates.insert(coordinates.end(), {x, y});
            weights.push_back(weight);
        }
    }

    Points points() const { return Points(coordinates, 2, weights); }

    Report report(Refine refine, double tolerance) const {
        Options asked = options;
        asked.refine = refine;
        asked.imbalance_tolerance = tolerance;
        return balance(points(), MPI_COMM_WORLD, asked).report;
    }
};

TEST(Tolerance, that_looks_like_per_cent_is_noticed_if_lines_are_asked_for) {
    const WeightedCloud cloud(1);
    setenv("RRCB_VERBOSE", "1", 1);
    for (const double tolerance : {1.05, 1.9, 2.0, 5.0}) {
        testing::internal::CaptureStdout();
        cloud.report(Refine::tolerance, tolerance);
        const std::string said = testing::internal::GetCapturedStdout();
        EXPECT_EQ(said.find("a part may weigh") != said.npos, rank() == 0 && tolerance >= 2);
        const std::string notice =
            "; a part may weigh 5 times the mean, for 5 % set imbalance_tolerance to 1.05\n";
        EXPECT_EQ(said.find(notice) != said.npos, rank() == 0 && tolerance == 5) << said;
    }
    unsetenv("RRCB_VERBOSE");
}

TEST(Tolerance, that_exact_reaches_is_never_missed) {
    int fell_back = 0;
    for (unsigned seed = 1; seed <= 120; ++seed) {
        const WeightedCloud cloud(seed);
        const double reached = cloud.report(Refine::exact, 1).imbalance;
        for (const double margin : {1e-3, 1e-2, 5e-2}) {
            const double tolerance = (1 + margin) * reached;
            const Report report = cloud.report(Refine::tolerance, tolerance);
            EXPECT_LE(report.imbalance, tolerance) << "seed " << seed;
            EXPECT_TRUE(report.within_tolerance);
            fell_back += report.imbalance == reached ? 1 : 0;
        }
    }
    EXPECT_GT(fell_back, 0) << "no case needs what exact finds: the test has no teeth";
}

TEST(Tolerance, that_nothing_reaches_is_reported_and_comes_as_near_as_exact) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        const WeightedCloud cloud(seed);
        const double reached = cloud.report(Refine::exact, 1).imbalance;
        if (reached <= 1 + 1e-6) continue;
        const Report report = cloud.report(Refine::tolerance, 1 + 1e-7);
        EXPECT_FALSE(report.within_tolerance);
        // The weights of a part are added up in the order in which its points are found.
        EXPECT_LE(report.imbalance, reached * (1 + 1e-12));
    }
}

TEST(Report, measures_parts_of_tiny_sizes_as_they_are) {
    // The part of a tiny size gets a point or none: its imbalance is beyond all bounds, or it is
    // empty; 0.1 told 1 from what the cuts should have left.
    std::vector<double> mine;
    for (int i = 0; i < 60; ++i)
        if (i % num_ranks() == rank()) mine.push_back(i);
    const Points points(mine, 1);
    for (const double tiny : {1e-310, 1e-120, 1e-20}) {
        Options options{.num_parts = 3, .part_sizes = {1, tiny, 1}};
        for (const Refine refine : {Refine::tolerance, Refine::exact}) {
            options.refine = refine;
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            const auto weights = part_weights(points, result.parts, 3, MPI_COMM_WORLD);
            EXPECT_EQ(result.report.imbalance, imbalance(weights, options.part_sizes));
            EXPECT_EQ(result.report.part_weights, weights);
        }
    }
}

TEST(Measures, of_a_balance_are_those_of_its_parts) {
    const std::vector<double> mine = test::uniform_cloud(500, 2, static_cast<unsigned>(rank() + 1));
    const Points points(mine, 2);
    Options options{.num_parts = 2 * num_ranks() + 1};
    const Balance result = balance(points, MPI_COMM_WORLD, options);
    EXPECT_EQ(part_weights(points, result, MPI_COMM_WORLD),
              part_weights(points, result.parts, options.num_parts, MPI_COMM_WORLD));
    EXPECT_EQ(moved_fraction(points, result, MPI_COMM_WORLD),
              moved_fraction(points, result.parts, options.num_parts, MPI_COMM_WORLD));
    const Plan lists = plan(result, MPI_COMM_WORLD);
    const Plan expected = plan(result.parts, options.num_parts, MPI_COMM_WORLD);
    EXPECT_EQ(lists.num_points, points.count);
    EXPECT_EQ(lists.export_parts, expected.export_parts);
    EXPECT_EQ(lists.import_indices, expected.import_indices);
}

TEST(Measures, refuse_weights_of_another_length_and_do_not_hide_those_that_are_no_numbers) {
    const std::vector<double> mine = test::uniform_cloud(20, 2, 1);
    const std::vector<Part> parts(20, 0);
    const std::vector<double> short_weights(rank() == 0 ? 9 : 20, 1.0);
    const Points points(mine, 2, short_weights);
    EXPECT_THROW(part_weights(points, parts, 1, MPI_COMM_WORLD), Error);
    EXPECT_THROW(moved_fraction(points, parts, 1, MPI_COMM_WORLD), Error);
    const std::vector<double> nan(20, std::nan(""));
    EXPECT_TRUE(std::isnan(moved_fraction(Points(mine, 2, nan), parts, 1, MPI_COMM_WORLD)));
}

TEST(PartSizes, of_any_magnitude_mean_the_same) {
    std::vector<double> mine = test::uniform_cloud(500, 2, static_cast<unsigned>(rank() + 1));
    for (const double weight : {1.0, 1e300, 1e-300}) {
        const std::vector<double> weights(500, weight);
        const Points points(mine, 2, weights);
        Options options{.num_parts = 4, .part_sizes = {3, 1, 2, 2}};
        const Balance first = balance(points, MPI_COMM_WORLD, options);
        EXPECT_LE(first.report.imbalance, 1.01);
        for (const double scale : {0x1p-1030, 0x1p1000}) {
            Options scaled = options;
            for (double& size : scaled.part_sizes) size *= scale;
            const Balance second = balance(points, MPI_COMM_WORLD, scaled);
            EXPECT_EQ(second.parts, first.parts) << weight << ", " << scale;
        }
    }
}

TEST(PartSizes, of_zero_keep_a_part_empty_of_weightless_points_too) {
    // One point of weight 1 and 99 of 0; three points and parts without any in the middle.
    std::vector<double> many;
    std::vector<double> weights;
    std::vector<double> few;
    for (int i = 0; i < 100; ++i) {
        if (i % num_ranks() != rank()) continue;
        many.insert(many.end(), {std::fmod(i * 0.618, 1), std::fmod(i * 0.414, 1)});
        weights.push_back(i == 31 ? 1 : 0);
        if (i < 3) few.push_back(i == 0 ? 8 : i == 1 ? 15 : 2);
    }
    const auto expect_empty = [](const Points& points, std::vector<double> sizes, Options options) {
        options.num_parts = static_cast<int>(sizes.size());
        options.part_sizes = sizes;
        Balance result = balance(points, MPI_COMM_WORLD, options);
        for (const Part part : result.parts) EXPECT_GT(sizes[static_cast<std::size_t>(part)], 0);
        std::ranges::reverse(options.part_sizes);
        std::ranges::reverse(sizes);
        result = balance(points, MPI_COMM_WORLD, options, result.cuts);
        for (const Part part : result.parts) EXPECT_GT(sizes[static_cast<std::size_t>(part)], 0);
    };
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
        Options options{.refine = refine};
        expect_empty(Points(many, 2, weights), {2, 1e-4, 0}, options);
        expect_empty(Points(many, 2, weights), {0, 3, 0, 0, 1}, options);
        expect_empty(Points(few, 1), {1, 0, 2, 2, 2}, options);
    }
}

}  // namespace
}  // namespace rrcb
