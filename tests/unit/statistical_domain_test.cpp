#include "../support/common.hpp"

#include <rrcb/detail/statistical_domain.hpp>
#include <rrcb/detail/support_mesh.hpp>

namespace rrcb {
namespace {

CellMoments cell(double lower, double upper, GlobalCount count, double weight, double mean,
                 double deviation) {
    CellMoments moments;
    moments.box.lower = {lower, 0, 0};
    moments.box.upper = {upper, 0, 0};
    moments.moments = {count, weight, {mean, 0, 0}, {deviation, 0, 0}};
    return moments;
}

Box interval(double lower, double upper) {
    return {{lower, 0, 0}, {upper, 0, 0}};
}

/// Mean and deviation of a domain along an axis, in long double.
struct Spread {
    double mean;
    double deviation;
};

/// By the moments of the Legendre polynomials: the mean of P1 is slope / 3, that of P2 bow / 5.
Spread spread_of(const StatisticalDomain& domain, std::size_t axis = 0) {
    using Number = long double;
    Number weight = 0;
    Number mean = 0;
    const auto mean_of = [&](const Patch& patch) {
        const Number half_width = Number{patch.upper[axis]} / 2 - Number{patch.lower[axis]} / 2;
        return Number{patch.lower[axis]} / 2 + Number{patch.upper[axis]} / 2 +
               half_width * patch.slope[axis] / 3;
    };
    for (const Patch& patch : domain.patches) {
        weight += patch.weight;
        mean += patch.weight * mean_of(patch);
    }
    mean /= weight;
    Number square = 0;
    for (const Patch& patch : domain.patches) {
        const Number half_width = Number{patch.upper[axis]} / 2 - Number{patch.lower[axis]} / 2;
        const Number slope = patch.slope[axis];
        const Number variance =
            1 / Number{3} + Number{patch.bow[axis]} * 2 / 15 - slope * slope / 9;
        const Number off = mean_of(patch) - mean;
        square += patch.weight * (off * off + half_width * half_width * variance) / weight;
    }
    return {static_cast<double>(mean), static_cast<double>(std::sqrt(square))};
}

/// Least density of a patch along an axis, at 1000 places.
double least_density(const Patch& patch, std::size_t axis) {
    double least = 1;
    for (int k = 0; k <= 1000; ++k) {
        const double u = k / 500.0 - 1;
        least = std::min(least, 1 + patch.slope[axis] * u + patch.bow[axis] * (3 * u * u - 1) / 2);
    }
    return least;
}

TEST(AnalyticDomain, is_one_patch_about_points_of_a_cell) {
    struct Row {
        CellMoments cell;
        double lower, upper, slope, bow;
    };
    const double root = std::sqrt(5.0);
    // On [0, 1] the density 2 x has the mean 2/3 and the variance 1/18. The parabola 1 - u^2 on
    // [-1, 1] has the variance 1/5. A uniform cell is restored. No extent is a point.
    for (const auto& [cell, lower, upper, slope, bow] :
         {Row{cell(0, 1, 5, 5, 2.0 / 3, std::sqrt(1.0 / 18)), 0, 1, 1, 0},
          {cell(0, 10, 5, 5, 4, 1), 4 - root, 4 + root, 0, -1},
          {cell(2, 6, 5, 5, 4, 4 / std::sqrt(12.0)), 2, 6, 0, 0},
          {cell(3, 3, 5, 5, 3, 0), 3, 3, 0, 0},
          {cell(0, 10, 5, 5, 10, 0), 10, 10, 0, 0}}) {
        const StatisticalDomain domain = analytic_domain(std::span(&cell, 1), 1, interval(0, 10));
        ASSERT_EQ(domain.patches.size(), 1u);
        EXPECT_NEAR(domain.patches[0].lower[0], lower, 1e-14);
        EXPECT_NEAR(domain.patches[0].upper[0], upper, 1e-14);
        EXPECT_EQ(domain.patches[0].weight, 5);
        EXPECT_NEAR(domain.patches[0].slope[0], slope, 1e-14);
        EXPECT_NEAR(domain.patches[0].bow[0], bow, 1e-14);
    }
}

TEST(AnalyticDomain, ends_in_the_cell_where_points_fill_a_side_of_it) {
    // (3 - x)^2 on [0, 3] in a cell of [0, 10]: mean 3/4, variance 9 * 3/80.
    const double deviation = std::sqrt(27.0 / 80);
    for (const bool is_mirrored : {false, true}) {
        const double mean = is_mirrored ? 9.25 : 0.75;
        const std::vector<CellMoments> cells{cell(0, 10, 5, 5, mean, deviation)};
        const StatisticalDomain domain = analytic_domain(cells, 1, interval(0, 10));
        ASSERT_EQ(domain.patches.size(), 1u);
        EXPECT_NEAR(domain.patches[0].lower[0], is_mirrored ? 7 : 0, 1e-6);
        EXPECT_NEAR(domain.patches[0].upper[0], is_mirrored ? 10 : 3, 1e-6);
        EXPECT_NEAR(spread_of(domain).mean, mean, 1e-14);
        EXPECT_NEAR(spread_of(domain).deviation, deviation, 1e-14);
    }
}

TEST(AnalyticDomain, is_two_boxes_where_points_crowd_at_a_face) {
    // Weight 6 on [0, 2] and 2 on [2, 8] have the mean (6 * 1 + 2 * 5) / 8 = 2 and the variance
    // (6 * 2^2 / 3 + 2 * 6^2 / 3) / 8 = 4.
    const std::vector<CellMoments> cells{cell(0, 10, 5, 8, 2, 2), cell(0, 10, 5, 8, 8, 2)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(-50, 50));
    ASSERT_EQ(domain.patches.size(), 4u);
    const std::array<double, 4> lower{0, 2, 8, 2};
    const std::array<double, 4> upper{2, 8, 10, 8};
    const std::array<double, 4> weight{6, 2, 6, 2};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(domain.patches[i].lower[0], lower[i], 1e-14);
        EXPECT_NEAR(domain.patches[i].upper[0], upper[i], 1e-14);
        EXPECT_NEAR(domain.patches[i].weight, weight[i], 1e-14);
        EXPECT_EQ(domain.patches[i].slope[0], 0);
        EXPECT_EQ(domain.patches[i].bow[0], 0);
    }
}

TEST(AnalyticDomain, of_points_at_both_ends_lies_at_both_ends) {
    const std::vector<CellMoments> cells{cell(0, 10, 2, 2, 5, 5), cell(0, 10, 4, 4, 7.5, 4.3)};
    const StatisticalDomain ends = analytic_domain(std::span(&cells[0], 1), 1, interval(-90, 20));
    ASSERT_EQ(ends.patches.size(), 2u);
    EXPECT_EQ(ends.patches[0].lower[0], ends.patches[0].upper[0]);
    EXPECT_EQ(ends.patches[0].lower[0], 0);
    EXPECT_EQ(ends.patches[1].lower[0], 10);
    EXPECT_EQ(ends.patches[1].weight, 1);
    const StatisticalDomain about = analytic_domain(std::span(&cells[1], 1), 1, interval(-90, 20));
    ASSERT_EQ(about.patches.size(), 2u);
    EXPECT_EQ(about.patches[0].upper[0], 10);
    EXPECT_NEAR(about.patches[1].lower[0], 0, 1e-14);
    EXPECT_NEAR(spread_of(about).mean, 7.5, 1e-14);
    EXPECT_NEAR(spread_of(about).deviation, 4.3, 1e-14);
}

TEST(AnalyticDomain, never_leaves_the_box_of_all_points) {
    // The cube of a lattice may reach beyond the points.
    const std::vector<CellMoments> cells{cell(0, 10, 5, 5, 4, 1.5), cell(0, 10, 5, 5, 2.9, 0.5)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(3, 8));
    for (const Patch& patch : domain.patches) {
        EXPECT_GE(patch.lower[0], 3);
        EXPECT_LE(patch.upper[0], 8);
    }
    const StatisticalDomain first = analytic_domain(std::span(&cells[0], 1), 1, interval(3, 8));
    EXPECT_NEAR(spread_of(first).mean, 4, 1e-14);
    EXPECT_NEAR(spread_of(first).deviation, 1.5, 1e-14);
}

/// All means and deviations that points in [-1, 1] may have, more densely at the ends.
std::vector<Spread> possible_spreads() {
    std::vector<Spread> spreads;
    for (int i = -60; i <= 60; ++i) {
        const double mean = std::sin(i * std::acos(0.0) / 60);
        for (int k = 0; k <= 60; ++k) {
            const double share = std::sin(k * std::acos(0.0) / 60);
            spreads.push_back({mean, share * std::sqrt(1 - mean * mean)});
        }
    }
    return spreads;
}

TEST(AnalyticDomain, has_any_moments_that_points_in_the_cell_may_have) {
    for (const auto& [mean, deviation] : possible_spreads()) {
        const std::vector<CellMoments> cells{cell(-1, 1, 9, 9, mean, deviation)};
        const StatisticalDomain domain = analytic_domain(cells, 1, interval(-1, 1));
        EXPECT_NEAR(spread_of(domain).mean, mean, 1e-14);
        // Points near a face have a deviation of the root of what their mean is rounded by.
        EXPECT_NEAR(spread_of(domain).deviation, deviation, mean * mean > 0.999 ? 1e-8 : 1e-12);
        for (const Patch& patch : domain.patches) {
            EXPECT_GE(patch.weight, 0);
            EXPECT_GE(patch.lower[0], -1);
            EXPECT_LE(patch.lower[0], patch.upper[0]);
            EXPECT_LE(patch.upper[0], 1);
            EXPECT_GE(least_density(patch, 0), -1e-12) << mean << ' ' << deviation;
        }
    }
}

TEST(AnalyticDomain, divides_along_each_axis_for_itself) {
    std::vector<CellMoments> cells{cell(0, 10, 5, 64, 2, 2)};
    cells[0].box = {{0, 0, 0}, {10, 10, 10}};
    cells[0].moments.mean = {2, 5, 8};
    cells[0].moments.deviation = {2, 1, 2};
    const StatisticalDomain domain = analytic_domain(cells, 3, cells[0].box);
    ASSERT_EQ(domain.patches.size(), 4u);
    std::vector<double> weights;
    for (const Patch& patch : domain.patches) weights.push_back(patch.weight);
    std::sort(weights.begin(), weights.end());
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(weights[i], (std::array<double, 4>{4, 12, 12, 36}[i]), 1e-13);
    for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_DOUBLE_EQ(spread_of(domain, a).mean, cells[0].moments.mean[a]);
        EXPECT_DOUBLE_EQ(spread_of(domain, a).deviation, cells[0].moments.deviation[a]);
    }
}

TEST(AnalyticDomain, keeps_the_moments_of_skewed_points_on_any_mesh) {
    std::mt19937_64 engine(1);
    std::vector<double> x(3000);
    for (double& coordinate : x) coordinate = std::pow(static_cast<double>(engine()) * 0x1p-64, 4);
    const Points points(x, 3);
    const Box box = bounding_box(points);
    for (const int mesh : {1, 2, 5}) {
        const auto cells = cell_moments(points, make_support_mesh(box, 3, mesh));
        for (const CellMoments& cell : cells) {
            const StatisticalDomain domain = analytic_domain(std::span(&cell, 1), 3, box);
            for (std::size_t a = 0; a < 3; ++a) {
                EXPECT_NEAR(spread_of(domain, a).mean, cell.moments.mean[a], 1e-15);
                EXPECT_NEAR(spread_of(domain, a).deviation, cell.moments.deviation[a], 1e-14);
            }
        }
    }
}

TEST(AnalyticDomain, survives_extreme_coordinates) {
    constexpr double largest = std::numeric_limits<double>::max();
    for (const double size : {1e-310, 1e-300, 1e300, largest}) {
        for (const double mean : {-size, -0.9 * size, 0.0, 0.5 * size, size}) {
            for (const double deviation : {0.0, 1e-9 * size, 0.1 * size, 0.5 * size, size}) {
                const std::vector<CellMoments> cells{cell(-size, size, 5, 5, mean, deviation)};
                const StatisticalDomain domain = analytic_domain(cells, 1, interval(-size, size));
                double weight = 0;
                for (const Patch& patch : domain.patches) {
                    EXPECT_LE(patch.lower[0], patch.upper[0]);
                    EXPECT_LE(std::max(-patch.lower[0], patch.upper[0]), size);
                    EXPECT_GE(patch.weight, 0);
                    weight += patch.weight;
                }
                EXPECT_DOUBLE_EQ(weight, 5);
            }
        }
    }
    const std::vector<CellMoments> cells{cell(-1e300, 1e300, 5, 5, -9e299, 1e299)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(-1e300, 1e300));
    EXPECT_DOUBLE_EQ(spread_of(domain).mean, -9e299);
    EXPECT_DOUBLE_EQ(spread_of(domain).deviation, 1e299);
}

TEST(AnalyticDomain, counts_stand_in_where_all_weights_are_zero) {
    const std::vector<CellMoments> cells{cell(0, 1, 3, 0, 0.5, 0), cell(1, 2, 1, 0, 1.5, 0)};
    const StatisticalDomain domain = analytic_domain(cells, 1, interval(0, 2));
    EXPECT_EQ(domain.patches[0].weight, 3);
    EXPECT_EQ(domain.patches[1].weight, 1);
}

}  // namespace
}  // namespace rrcb
