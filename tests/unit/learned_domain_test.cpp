#include "bisection/learned_domain.hpp"

#include "bisection/sub_cell_tilt.hpp"

#include <rrcb/points.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace rrcb {
namespace {

using Number = long double;

constexpr Number centre_of(int k) {
    return (k + Number{0.5}) / num_sub - Number{0.5};
}

/// Mean and deviation along an axis of sub-cells that are even, in long double.
std::pair<Number, Number> spread_of(const SubCells& shares, int axis) {
    Number sum = 0;
    Number first = 0;
    Number second = 0;
    for (int k = 0; k < shares.size(); ++k) {
        const Number x = centre_of(axis == 0 ? k / num_sub : k % num_sub);
        sum += shares[k];
        first += shares[k] * x;
        second += shares[k] * (x * x + Number{1} / (12 * num_sub * num_sub));
    }
    const Number mean = first / sum;
    return {mean, std::sqrt(second / sum - mean * mean)};
}

CellSpread random_spread(std::mt19937& engine) {
    std::uniform_real_distribution<double> mean(-0.35, 0.35);
    std::uniform_real_distribution<double> share(0.25, 0.9);
    CellSpread spread;
    for (std::size_t a = 0; a < 2; ++a) {
        spread.mean[a] = mean(engine);
        spread.deviation[a] =
            share(engine) * std::sqrt((0.5 - spread.mean[a]) * (0.5 + spread.mean[a]));
    }
    return spread;
}

TEST(Tilt, gives_any_prior_the_moments) {
    std::mt19937 engine(1);
    std::normal_distribution<double> exponent(0, 2);
    int num_tilted = 0;
    for (int round = 0; round < 300; ++round) {
        SubCells prior;
        for (double& number : prior) number = exponent(engine);
        const CellSpread spread = random_spread(engine);
        const auto shares = tilted(prior, spread);
        if (!shares) continue;
        ++num_tilted;
        EXPECT_GE(shares->minCoeff(), 0);
        for (int a = 0; a < 2; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            const auto [mean, deviation] = spread_of(*shares, a);
            EXPECT_NEAR(static_cast<double>(mean), spread.mean[axis], 1e-12);
            EXPECT_NEAR(static_cast<double>(deviation), spread.deviation[axis], 1e-11);
        }
    }
    EXPECT_GT(num_tilted, 240);
}

TEST(Tilt, of_an_even_prior_has_quadratic_exponents_along_each_axis) {
    const auto shares = tilted(SubCells::Zero(), {{0.1, -0.2}, {0.25, 0.15}});
    ASSERT_TRUE(shares.has_value());
    const auto exponent = [&](int x, int y) { return std::log((*shares)[x * num_sub + y]); };
    for (int x = 0; x + 1 < num_sub; ++x)
        for (int y = 0; y + 1 < num_sub; ++y)
            EXPECT_NEAR(exponent(x, y) + exponent(x + 1, y + 1),
                        exponent(x + 1, y) + exponent(x, y + 1), 1e-10);
    for (int k = 0; k + 3 < num_sub; ++k) {
        EXPECT_NEAR(exponent(k + 3, 0) - exponent(k, 0),
                    3 * (exponent(k + 2, 0) - exponent(k + 1, 0)), 1e-10);
        EXPECT_NEAR(exponent(0, k + 3) - exponent(0, k),
                    3 * (exponent(0, k + 2) - exponent(0, k + 1)), 1e-10);
    }
}

TEST(Tilt, has_nothing_where_sub_cells_can_have_no_such_moments) {
    for (const double deviation : {0.0, 1e-300, 0.01, 0.03, 0.5, 1e300}) {
        EXPECT_FALSE(tilted(SubCells::Zero(), {{0, 0}, {deviation, 0.2}})) << deviation;
        EXPECT_FALSE(tilted(SubCells::Zero(), {{0, 0}, {0.2, deviation}})) << deviation;
    }
    for (const double mean : {-0.5, 0.5, 0.44})
        EXPECT_FALSE(tilted(SubCells::Zero(), {{mean, 0}, {0.05, 0.2}})) << mean;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(tilted(SubCells::Zero(), {{nan, 0}, {0.2, 0.2}}));
}

/// Points below a line, or mirrored, spread evenly: Roberts' sequence with the plastic number.
std::vector<double> points_below_a_line(int symmetry = 0) {
    constexpr double plastic = 1.32471795724474602596;
    std::vector<double> coordinates;
    double x = 0.5;
    double y = 0.5;
    for (int i = 0; i < 150'000; ++i) {
        x = std::fmod(x + 1 / plastic, 1);
        y = std::fmod(y + 1 / (plastic * plastic), 1);
        if (y > 0.25 + 0.37 * x) continue;
        double u = (symmetry & 1) != 0 ? 1 - x : x;
        double v = (symmetry & 2) != 0 ? 1 - y : y;
        if ((symmetry & 4) != 0) std::swap(u, v);
        coordinates.insert(coordinates.end(), {u, v});
    }
    return coordinates;
}

/// Weight of a domain of patches without slope below a corner along both axes, in shares of a
/// patch.
double weight_below(const StatisticalDomain& domain, double x, double y) {
    double sum = 0;
    const auto share = [](double lower, double upper, double at) {
        return std::clamp((at - lower) / (upper - lower), 0.0, 1.0);
    };
    for (const Patch& p : domain.patches)
        sum += p.weight * share(p.lower[0], p.upper[0], x) * share(p.lower[1], p.upper[1], y);
    return sum;
}

struct Meshed {
    SupportMesh mesh;
    std::vector<CellMoments> cells;
    Box box;
};

Meshed meshed(const Points& points, int cells_per_axis) {
    Meshed result;
    result.box = bounding_box(points);
    result.mesh = make_support_mesh(result.box, points.dimension, cells_per_axis);
    result.cells = cell_moments(points, result.mesh);
    return result;
}

/// Patches of the learned domain that lie in a cell.
StatisticalDomain patches_in(const StatisticalDomain& domain, const Box& cell) {
    StatisticalDomain inside{domain.dimension};
    for (const Patch& patch : domain.patches) {
        const double x = patch.lower[0] / 2 + patch.upper[0] / 2;
        const double y = patch.lower[1] / 2 + patch.upper[1] / 2;
        if (x > cell.lower[0] && x < cell.upper[0] && y > cell.lower[1] && y < cell.upper[1])
            inside.patches.push_back(patch);
    }
    return inside;
}

/// Error of the corner weights inside the cells that the learned domain gave sub-cells, beside the
/// points; of an even prior with the same moments for comparison.
struct Errors {
    double learned = 0;
    double even = 0;
    int num_cells = 0;
};

Errors errors_below_a_line(int symmetry) {
    const std::vector<double> coordinates = points_below_a_line(symmetry);
    const Points points = interleaved_points(coordinates, 2);
    const auto [mesh, cells, box] = meshed(points, 9);
    const StatisticalDomain domain = learned_domain(cells, mesh, box);
    Errors errors;
    for (const CellMoments& cell : cells) {
        const StatisticalDomain inside = patches_in(domain, cell.box);
        if (inside.patches.size() < num_sub * num_sub) continue;
        ++errors.num_cells;
        std::vector<Vector> here;
        for (LocalIndex i = 0; i < points.count; ++i)
            if (cell_of(mesh, points.position(i)) == cell.cell) here.push_back(points.position(i));
        CellSpread spread;
        Vector extent{};
        for (std::size_t a = 0; a < 2; ++a) {
            extent[a] = cell.box.upper[a] - cell.box.lower[a];
            spread.mean[a] = (cell.moments.mean[a] - cell.box.lower[a]) / extent[a] - 0.5;
            spread.deviation[a] = cell.moments.deviation[a] / extent[a];
        }
        const SubCells even = tilted(SubCells::Zero(), spread).value();
        for (int k = 0; k < num_sub * num_sub; ++k) {
            const Vector corner{cell.box.lower[0] + extent[0] * (k / num_sub + 1) / num_sub,
                                cell.box.lower[1] + extent[1] * (k % num_sub + 1) / num_sub, 0};
            const auto truth = static_cast<double>(std::ranges::count_if(
                here, [&](const Vector& x) { return x[0] < corner[0] && x[1] < corner[1]; }));
            double of_even = 0;
            for (int l = 0; l < num_sub * num_sub; ++l)
                if (l / num_sub <= k / num_sub && l % num_sub <= k % num_sub)
                    of_even += cell.moments.weight * even[l];
            errors.learned += std::pow(weight_below(inside, corner[0], corner[1]) - truth, 2);
            errors.even += std::pow(of_even - truth, 2);
        }
    }
    return errors;
}

TEST(LearnedDomain, knows_how_points_lie_below_a_line_in_any_direction) {
    for (int symmetry = 0; symmetry < 8; ++symmetry) {
        const Errors errors = errors_below_a_line(symmetry);
        EXPECT_GE(errors.num_cells, 5) << symmetry;
        EXPECT_LT(std::sqrt(errors.learned), std::sqrt(errors.even) / 2) << symmetry;
    }
}

void expect_same(const StatisticalDomain& a, const StatisticalDomain& b) {
    ASSERT_EQ(a.patches.size(), b.patches.size());
    for (std::size_t i = 0; i < a.patches.size(); ++i) {
        EXPECT_EQ(a.patches[i].lower, b.patches[i].lower);
        EXPECT_EQ(a.patches[i].upper, b.patches[i].upper);
        EXPECT_EQ(a.patches[i].weight, b.patches[i].weight);
        EXPECT_EQ(a.patches[i].slope, b.patches[i].slope);
        EXPECT_EQ(a.patches[i].bow, b.patches[i].bow);
    }
}

void expect_analytic(const std::vector<double>& coordinates, int dimension, int cells_per_axis,
                     const std::vector<double>& weights = {}) {
    const Points points = interleaved_points(coordinates, dimension, weights);
    const auto [mesh, cells, box] = meshed(points, cells_per_axis);
    expect_same(learned_domain(cells, mesh, box), analytic_domain(cells, dimension, box));
}

std::vector<double> random_points(std::size_t count, int dimension) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> coordinates(count * static_cast<std::size_t>(dimension));
    for (double& x : coordinates) x = uniform(engine);
    return coordinates;
}

TEST(LearnedDomain, is_analytic_where_there_is_nothing_to_learn_from) {
    expect_analytic(random_points(20'000, 2), 2, 8);   // even
    expect_analytic(random_points(20'000, 3), 3, 6);   // in space
    expect_analytic(random_points(20'000, 1), 1, 20);  // on a line
    expect_analytic(points_below_a_line(), 2, 1);      // one cell
    expect_analytic({0.3, 0.7}, 2, 4);                 // one point
    expect_analytic({0, 0, 1, 1, 1, 0, 0, 1}, 2, 2);   // on the corners
    expect_analytic(random_points(100, 2), 2, 10);     // about a point in each cell
    std::vector<double> level = points_below_a_line();
    for (std::size_t i = 1; i < level.size(); i += 2) level[i] = 5;
    expect_analytic(level, 2, 8);
}

TEST(LearnedDomain, keeps_weight_and_moments_at_any_scale) {
    const std::vector<double> unit = points_below_a_line();
    for (const double scale : {1.0, 0x1p-1000, 0x1p1000}) {
        for (const double weight : {1.0, 0x1p-1000, 0x1p900}) {
            std::vector<double> coordinates = unit;
            for (double& x : coordinates) x *= scale;
            const std::vector<double> weights(unit.size() / 2, weight);
            const Points points = interleaved_points(coordinates, 2, weights);
            const auto [mesh, cells, box] = meshed(points, 9);
            const StatisticalDomain domain = learned_domain(cells, mesh, box);
            EXPECT_GT(domain.patches.size(), cells.size() + 5 * 63);
            for (const CellMoments& cell : cells) {
                Number sum = 0;
                Number mean = 0;
                const StatisticalDomain inside = patches_in(domain, cell.box);
                if (inside.patches.size() < num_sub * num_sub) continue;
                for (const Patch& patch : inside.patches) {
                    sum += patch.weight;
                    mean += Number{patch.weight} * (patch.lower[0] / 2 + patch.upper[0] / 2);
                }
                EXPECT_NEAR(static_cast<double>(sum / cell.moments.weight), 1, 1e-13);
                EXPECT_NEAR(static_cast<double>(mean / sum / scale), cell.moments.mean[0] / scale,
                            1e-12);
            }
        }
    }
}

TEST(LearnedDomain, survives_weights_over_many_decades) {
    const std::vector<double> coordinates = points_below_a_line();
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> exponent(-30, 30);
    std::vector<double> weights(coordinates.size() / 2);
    for (double& weight : weights) weight = std::pow(10, exponent(engine));
    const Points points = interleaved_points(coordinates, 2, weights);
    const auto [mesh, cells, box] = meshed(points, 9);
    double sum = 0;
    for (const Patch& patch : learned_domain(cells, mesh, box).patches) {
        EXPECT_GT(patch.weight, 0);
        EXPECT_TRUE(std::isfinite(patch.weight));
        for (std::size_t a = 0; a < 2; ++a) EXPECT_LE(patch.lower[a], patch.upper[a]);
        sum += patch.weight;
    }
    double expected = 0;
    for (const double weight : weights) expected += weight;
    EXPECT_NEAR(sum / expected, 1, 1e-12);
}

TEST(LearnedDomain, of_several_meshes_is_that_of_each) {
    const std::vector<double> coordinates = points_below_a_line();
    const std::size_t half = coordinates.size() / 4 * 2;
    const std::span<const double> all(coordinates);
    const Box box = bounding_box(interleaved_points(all, 2));
    CellSet set;
    StatisticalDomain expected{2};
    for (const auto& part : {all.first(half), all.subspan(half)}) {
        const Meshed one = meshed(interleaved_points(part, 2), 9);
        set.blocks.push_back({set.cells.size(), set.cells.size() + one.cells.size(), one.mesh});
        set.cells.insert(set.cells.end(), one.cells.begin(), one.cells.end());
        for (const Patch& patch : learned_domain(one.cells, one.mesh, box).patches)
            expected.patches.push_back(patch);
    }
    expect_same(learned_domain(set, 2, box), expected);
    set.blocks.clear();
    expect_same(learned_domain(set, 2, box), analytic_domain(set.cells, 2, box));
}

}  // namespace
}  // namespace rrcb
