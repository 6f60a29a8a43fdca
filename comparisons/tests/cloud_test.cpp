#include "cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace comparisons {
namespace {

double ground(double x) {
    if (x <= 30) return 20;
    return x < 50 ? 50 - x : 0;
}

TEST(Cloud, fills_the_outline_of_the_slope_evenly) {
    constexpr int count = 49'000;
    const std::vector<double> points = cloud_points({"slope", count, 2, 1}, 0, count);
    int above_toe_level = 0;
    for (std::size_t i = 0; i < points.size(); i += 2) {
        const double x = points[i];
        const double z = points[i + 1];
        EXPECT_TRUE(x >= 0 && x <= 110 && z >= -15 && z <= ground(x)) << x << ' ' << z;
        above_toe_level += z > 0;
    }
    // These parts have 600 + 200 of 2450 square metres. The tolerance is five standard deviations
    // of the binomial distribution.
    const double share = 800.0 / 2450;
    EXPECT_NEAR(above_toe_level, share * count, 5 * std::sqrt(count * share * (1 - share)));
}

TEST(Cloud, extrudes_the_slope_by_forty_metres) {
    const std::vector<double> points = cloud_points({"slope", 1000, 3, 1}, 0, 1000);
    for (std::size_t i = 0; i < points.size(); i += 3) {
        EXPECT_TRUE(points[i + 1] >= 0 && points[i + 1] <= 40);
        EXPECT_LE(points[i + 2], ground(points[i]));
    }
}

TEST(Cloud, numbers_the_lattice_along_the_first_axis) {
    // The smallest square lattice with at least 7 points is 3 x 3.
    const std::vector<double> expected = {0, 1, 1, 1, 2, 1, 0, 2};
    EXPECT_EQ(cloud_points({"lattice", 7, 2, 1}, 3, 7), expected);
}

TEST(Cloud, gives_a_point_by_its_number_alone) {
    for (const char* name :
         {"uniform", "slope", "clusters", "lattice", "run_out", "polygon", "shell", "spiral",
          "slab", "wave", "drops", "pile", "diagonal", "cusps", "jets", "web", "discs"}) {
        const Cloud cloud{name, 100, 3, 7};
        const std::vector<double> all = cloud_points(cloud, 0, 100);
        const std::vector<double> piece = cloud_points(cloud, 40, 60);
        EXPECT_TRUE(std::equal(piece.begin(), piece.end(), all.begin() + 120)) << name;
    }
}

TEST(Cloud, changes_with_the_seed) {
    EXPECT_NE(cloud_points({"uniform", 10, 2, 1}, 0, 10),
              cloud_points({"uniform", 10, 2, 2}, 0, 10));
}

}  // namespace
}  // namespace comparisons
