#include <rrcb/eigen.hpp>
#include <rrcb/points.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rrcb {
namespace {

TEST(Points, interleaved_and_columns_are_the_same_points) {
    const std::vector<double> interleaved{1, 10, 2, 20, 3, 30};
    const std::vector<double> x{1, 2, 3};
    const std::vector<double> y{10, 20, 30};
    const std::array<std::span<const double>, 2> columns{x, y};
    const Points a = interleaved_points(interleaved, 2);
    const Points b = column_points(columns);
    ASSERT_EQ(a.count, 3u);
    ASSERT_EQ(b.count, 3u);
    for (LocalIndex i = 0; i < 3; ++i) {
        EXPECT_EQ(a.position(i), b.position(i));
        EXPECT_EQ(a.position(i)[1], 10.0 * static_cast<double>(i + 1));
    }
}

TEST(Points, eigen_matrices_are_viewed_in_place) {
    Eigen::Matrix<double, 3, Eigen::Dynamic> matrix(3, 2);
    matrix << 1, 2, 3, 4, 5, 6;
    const Points points = eigen_points(matrix);
    EXPECT_EQ(points.dimension, 3);
    EXPECT_EQ(points.count, 2u);
    EXPECT_EQ(points.position(1), (Vector{2, 4, 6}));
    EXPECT_EQ(points.axes[0].data(), matrix.data());
}

TEST(Points, bounding_box_takes_every_point_in_for_any_count) {
    for (std::size_t count = 1; count < 12; ++count) {
        std::vector<double> coordinates;
        for (std::size_t i = 0; i < count; ++i) {
            coordinates.push_back(static_cast<double>(i));
            coordinates.push_back(-static_cast<double>(i * i));
        }
        const Box box = bounding_box(interleaved_points(coordinates, 2));
        const auto last = static_cast<double>(count - 1);
        EXPECT_EQ(box.lower[0], 0);
        EXPECT_EQ(box.upper[0], last);
        EXPECT_EQ(box.lower[1], -last * last);
        EXPECT_EQ(box.upper[1], 0);
    }
}

TEST(Points, bounding_box_tells_of_coordinates_that_are_no_numbers) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {std::nan(""), infinity, -infinity}) {
        for (std::size_t place = 0; place < 9; ++place) {
            std::vector<double> coordinates(18, 1.0);
            coordinates[2 * place + 1] = bad;
            const Box box = bounding_box(interleaved_points(coordinates, 2));
            EXPECT_EQ(box.lower[0], 1);
            EXPECT_TRUE(std::isnan(box.lower[1]));
        }
    }
}

TEST(Points, bounding_box_of_no_points_is_empty) {
    const Box box = bounding_box(interleaved_points({}, 3));
    EXPECT_GT(box.lower[0], box.upper[0]);
}

}  // namespace
}  // namespace rrcb
