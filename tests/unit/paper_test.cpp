#include "../support/clouds.hpp"
#include "../support/common.hpp"

#include <rrcb/detail/paper_steps.hpp>
#include <rrcb/error.hpp>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

CellMoments cell(GlobalCount count, double weight, double mean, double deviation) {
    CellMoments made;
    made.moments = {count, weight, {mean, 0, 0}, {deviation, 0, 0}};
    return made;
}

TEST(SamplePoints, shares_points_by_largest_remainder) {
    // 10 * (5, 3, 1) / 9 = 5.56, 3.33, 1.11: the point left over goes to the first cell.
    const std::vector<CellMoments> cells{cell(5, 5, 0, 0), cell(3, 3, 1, 0), cell(2, 1, 2, 0)};
    const std::vector<MassPoint> points = sample_points(cells, 1, {});
    ASSERT_EQ(points.size(), 10u);
    std::array<int, 3> counts{};
    for (const MassPoint& point : points) ++counts[static_cast<std::size_t>(point.position[0])];
    EXPECT_EQ(counts, (std::array{6, 3, 1}));
}

TEST(SamplePoints, shares_points_by_number_if_all_weights_are_zero) {
    const std::vector<CellMoments> cells{cell(3, 0, 0, 0), cell(1, 0, 1, 0)};
    const std::vector<MassPoint> points = sample_points(cells, 1, {});
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(points[2].position[0], 0);
    EXPECT_EQ(points[3].position[0], 1);
}

TEST(SamplePoints, draws_the_fraction_asked_for_within_the_multiplier) {
    const std::vector<CellMoments> cells{cell(1000, 1000, 0.5, 0.1)};
    PaperOptions options{.sigma_multiplier = 2, .sample_fraction = 0.125};
    const std::vector<MassPoint> points = sample_points(cells, 1, options);
    ASSERT_EQ(points.size(), 125u);
    double mean = 0;
    for (const MassPoint& point : points) {
        EXPECT_EQ(point.weight, 1);
        EXPECT_GE(point.position[0], 0.5 - 0.2);
        EXPECT_LT(point.position[0], 0.5 + 0.2);
        mean += point.position[0] / 125;
    }
    EXPECT_NEAR(mean, 0.5, 4 * 0.4 / std::sqrt(12.0 * 125));
}

TEST(SamplePoints, draws_one_point_at_least_and_none_of_no_cells) {
    PaperOptions options{.sample_fraction = 1e-9};
    EXPECT_EQ(sample_points(std::vector{cell(10, 1, 0.5, 0.1)}, 1, options).size(), 1u);
    EXPECT_TRUE(sample_points({}, 2, {}).empty());
}

TEST(SamplePoints, takes_the_points_from_the_seed) {
    const std::vector<CellMoments> cells{cell(50, 50, 0.5, 0.1)};
    const auto first_point = [&](std::uint64_t seed) {
        PaperOptions options{.seed = seed};
        return sample_points(cells, 1, options)[0].position[0];
    };
    EXPECT_EQ(first_point(1), first_point(1));
    EXPECT_NE(first_point(1), first_point(2));
    // First output of the 64-bit Mersenne Twister with seed 5489 (ISO C++ [rand.predef] engine).
    const double u = static_cast<double>(14514284786278117030u >> 11) * 0x1p-53;
    EXPECT_DOUBLE_EQ(first_point(5489), 0.35 + 0.3 * u);
}

TEST(SamplePoints, counts_more_points_than_32_bits_hold) {
    constexpr GlobalCount two_to_the_32 = GlobalCount{1} << 32;
    const std::vector<CellMoments> cells{cell(two_to_the_32 * 3, 0x3p32, 0.5, 0.1),
                                         cell(two_to_the_32, 0x1p32, 5.5, 0.1)};
    PaperOptions options;
    options.sample_fraction = 0x1p-29;  // 2^34 points give 2^5, 24 and 8 of them in the two cells
    const std::vector<MassPoint> points = sample_points(cells, 1, options);
    ASSERT_EQ(points.size(), 32u);
    EXPECT_LT(points[23].position[0], 3);
    EXPECT_GT(points[24].position[0], 3);
}

TEST(MassPoints, are_the_points_with_their_weights) {
    const std::vector<double> coordinates{1, 2, 3, 4};
    const std::vector<double> weights{5, 6};
    const std::vector<MassPoint> points = mass_points(Points(coordinates, 2, weights));
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[1].position, (Vector{3, 4, 0}));
    EXPECT_EQ(points[1].weight, 6);
}

TEST(MassPoints, weigh_one_each_if_no_point_has_weight) {
    const std::vector<double> coordinates{1, 2, 3, 4};
    const std::vector<double> zeros(2);
    for (const auto& points :
         {mass_points(Points(coordinates, 2, zeros)), mass_points(Points(coordinates, 2))}) {
        ASSERT_EQ(points.size(), 2u);
        EXPECT_EQ(points[0].weight, 1);
    }
}

std::vector<MassPoint> points_on_axis(std::initializer_list<double> values) {
    std::vector<MassPoint> points;
    for (const double value : values) points.push_back({{value, 0, 0}, 1});
    return points;
}

std::vector<GlobalCount> counts_of(const Cuts& cuts, const Points& points) {
    std::vector<Part> parts(points.count);
    assign(cuts, points, parts);
    std::vector<GlobalCount> counts(static_cast<std::size_t>(cuts.num_parts));
    for (const Part part : parts) ++counts[static_cast<std::size_t>(part)];
    return counts;
}

TEST(BisectPoints, is_exact_for_every_number_of_parts) {
    const std::vector<double> cloud = test::uniform_cloud(1000, 2, 23);
    const Points points(cloud, 2);
    for (int parts = 1; parts <= 17; ++parts) {
        const Cuts cuts = bisect_points(mass_points(points), 2, parts).cuts;
        const double ideal = 1000.0 / parts;
        for (const GlobalCount count : counts_of(cuts, points))
            EXPECT_LE(std::abs(static_cast<double>(count) - ideal), 2) << parts << " parts";
    }
}

TEST(BisectPoints, crosses_the_longest_extent_of_what_each_box_holds) {
    // The lower half is long in y, the upper one, with less weight, in x.
    std::vector<MassPoint> points{{{0, 0, 0}, 1}, {{1, 5, 0}, 1}, {{6, 0, 0}, 1}, {{9, 1, 0}, 1}};
    const Cuts cuts = bisect_points(points, 2, 4).cuts;
    EXPECT_EQ(cuts.tree[0].axis, 0);
    EXPECT_EQ(cuts.tree[1].axis, 1);
    EXPECT_EQ(cuts.tree[2].axis, 0);
    EXPECT_EQ(cuts.tree[0].at[0], 3.5);
    EXPECT_EQ(cuts.tree[1].at[1], 2.5);
    EXPECT_EQ(cuts.tree[2].at[0], 7.5);
}

TEST(BisectPoints, crosses_the_longer_of_two_nearly_equal_extents) {
    const std::vector<MassPoint> points{{{0, 0, 0}, 1}, {{2.99, 3, 0}, 1}};
    EXPECT_EQ(bisect_points(points, 2, 2).cuts.tree[0].axis, 1);
}

TEST(BisectPoints, puts_midpoints_at_the_share_of_the_extent_whatever_the_weight) {
    const std::vector<MassPoint> points = points_on_axis({0, 0.5, 0.75, 1, 10});
    const auto cut = [&](std::vector<double> sizes) {
        return bisect_points(points, 1, static_cast<int>(sizes.size()), sizes, CutRule::midpoint)
            .cuts.tree[0]
            .at[0];
    };
    EXPECT_DOUBLE_EQ(cut({1, 1}), 5);
    EXPECT_DOUBLE_EQ(cut({1, 3}), 2.5);
    EXPECT_EQ(cut({0, 1}), -infinity);
    EXPECT_EQ(cut({1, 0}), infinity);
    const Bisection halves = bisect_points(points, 1, 2, {}, CutRule::midpoint);
    EXPECT_EQ(halves.part_weights, (std::vector<double>{4, 1}));
}

TEST(BisectPoints, honours_relative_part_sizes_with_zeros) {
    const std::vector<double> cloud = test::uniform_cloud(800, 2, 5);
    const std::vector<double> sizes{1, 0, 0, 2, 5};
    const Points points(cloud, 2);
    const Bisection result = bisect_points(mass_points(points), 2, 5, sizes);
    EXPECT_EQ(result.part_weights, (std::vector<double>{100, 0, 0, 200, 500}));
    EXPECT_EQ(counts_of(result.cuts, points), (std::vector<GlobalCount>{100, 0, 0, 200, 500}));
}

TEST(BisectPoints, breaks_ties_of_a_lattice_by_position_unless_cuts_are_plain) {
    // 4 columns of 4 points, 3 parts: no plane leaves a third on one side.
    std::vector<double> lattice;
    for (int i = 0; i < 16; ++i) lattice.insert(lattice.end(), {double(i / 4), double(i % 4)});
    const Points points(lattice, 2);
    for (const int parts : {2, 3, 5, 16}) {
        const Cuts cuts = bisect_points(mass_points(points), 2, parts).cuts;
        const auto [least, most] = std::ranges::minmax(counts_of(cuts, points));
        EXPECT_LE(most - least, 1) << parts << " parts";
    }
    const auto plain =
        bisect_points(mass_points(points), 2, 3, {}, CutRule::weighted_fraction, true);
    EXPECT_EQ(plain.part_weights, (std::vector<double>{4, 6, 6}));
}

TEST(BisectPoints, keeps_coincident_points_together) {
    const std::vector<double> same(20, 1.5);
    const Points points(same, 2);
    const Bisection result = bisect_points(mass_points(points), 2, 4);
    EXPECT_EQ(std::ranges::max(counts_of(result.cuts, points)), 10);
    EXPECT_EQ(std::accumulate(result.part_weights.begin(), result.part_weights.end(), 0.0), 10);
}

TEST(BisectPoints, returns_the_weights_of_the_assigned_points) {
    const std::vector<double> cloud = test::uniform_cloud(777, 3, 29);
    const Points points(cloud, 3);
    for (const CutRule rule : {CutRule::weighted_fraction, CutRule::midpoint}) {
        const Bisection result = bisect_points(mass_points(points), 3, 11, {}, rule);
        const auto counts = counts_of(result.cuts, points);
        EXPECT_EQ(std::vector<double>(counts.begin(), counts.end()), result.part_weights);
    }
}

TEST(BisectPoints, leaves_all_parts_of_nothing_empty) {
    for (const CutRule rule : {CutRule::weighted_fraction, CutRule::midpoint}) {
        const Bisection result = bisect_points({}, 2, 3, {}, rule);
        EXPECT_EQ(result.cuts.tree.size(), 2u);
        EXPECT_EQ(result.part_weights, (std::vector<double>{0, 0, 0}));
    }
}

TEST(PaperStages, refuse_arguments_out_of_range) {
    for (const auto& [parts, sizes] : std::vector<std::pair<int, std::vector<double>>>{
             {0, {}}, {-1, {}}, {3, {1, 2}}, {3, {1, 2, -3}}, {2, {0, 0}}, {2, {1, NAN}}})
        EXPECT_THROW(bisect_points({}, 2, parts, sizes), Error);
    EXPECT_THROW(bisect_points({}, 9, 2), Error);
    Points nowhere({}, 2);
    nowhere.count = 3;
    EXPECT_THROW(mass_points(nowhere), Error);
    EXPECT_THROW(sample_points({}, 0, {}), Error);
    PaperOptions options{.sample_fraction = -1};
    EXPECT_THROW(sample_points({}, 2, options), Error);
    options.sample_fraction = 1;
    options.sigma_multiplier = infinity;
    EXPECT_THROW(sample_points({}, 2, options), Error);
}

TEST(BisectPoints, survives_the_whole_range_of_double) {
    constexpr double huge = std::numeric_limits<double>::max();
    for (const CutRule rule : {CutRule::weighted_fraction, CutRule::midpoint}) {
        const Bisection result = bisect_points(points_on_axis({-huge, huge}), 1, 2, {}, rule);
        EXPECT_EQ(result.cuts.tree[0].at[0], 0);
        EXPECT_EQ(result.part_weights, (std::vector<double>{1, 1}));
    }
    EXPECT_EQ(bisect_points(points_on_axis({0, 5e-324}), 1, 2).cuts.tree[0].at[0], 5e-324);
}

}  // namespace
}  // namespace rrcb
