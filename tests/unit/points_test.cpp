#include "../support/all_collected.hpp"
#include "../support/clouds.hpp"
#include "../support/common.hpp"

#include <rrcb/detail/moments.hpp>
#include <rrcb/error.hpp>
#include <rrcb/points.hpp>

#include <Eigen/Core>

namespace rrcb {
namespace {

TEST(Points, interleaved_and_columns_are_the_same_points) {
    const std::vector<double> interleaved{1, 10, 2, 20, 3, 30};
    const std::vector<double> x{1, 2, 3};
    const std::vector<double> y{10, 20, 30};
    const std::array<std::span<const double>, 2> columns{x, y};
    const Points a(interleaved, 2);
    const Points b(columns);
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
    const Points points(matrix);
    EXPECT_EQ(points.dimension, 3);
    EXPECT_EQ(points.count, 2u);
    EXPECT_EQ(points.position(1), (Vector{2, 4, 6}));
    EXPECT_EQ(points.axes[0], matrix.data());
    const Eigen::Matrix<float, 3, Eigen::Dynamic> floats = matrix.cast<float>();
    EXPECT_EQ(Points(floats).position(1), (Vector{2, 4, 6}));
    const Eigen::Matrix<double, 3, 2, Eigen::RowMajor> rows = matrix;
    EXPECT_EQ(Points(rows).position(1), (Vector{2, 4, 6}));
}

TEST(Points, bounding_box_takes_every_point_in_for_any_count) {
    for (std::size_t count = 1; count < 12; ++count) {
        std::vector<double> coordinates;
        for (std::size_t i = 0; i < count; ++i) {
            coordinates.push_back(static_cast<double>(i));
            coordinates.push_back(-static_cast<double>(i * i));
        }
        const Box box = bounding_box(Points(coordinates, 2));
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
            const Box box = bounding_box(Points(coordinates, 2));
            EXPECT_EQ(box.lower[0], 1);
            EXPECT_TRUE(std::isnan(box.lower[1]));
        }
    }
}

/// Coordinates that are members of structs, or interleaved in arrays of their own.
TEST(Points, at_any_stride_and_in_several_arrays_are_the_points_one_after_the_other) {
    for (const int dimension : {1, 2, 3}) {
        for (const std::size_t stride : {2u, 3u, 7u}) {
            const std::size_t count = 50;
            const auto axes = static_cast<std::size_t>(dimension);
            const std::vector<double> coordinates = test::uniform_cloud(count, dimension, 5);
            std::vector<std::vector<double>> arrays(axes);
            Points points;
            points.dimension = dimension;
            points.count = count;
            points.stride = stride * sizeof(double);
            for (std::size_t a = 0; a < axes; ++a) {
                arrays[a].assign((count - 1) * stride + 1, 1e300);
                for (std::size_t i = 0; i < count; ++i)
                    arrays[a][i * stride] = coordinates[i * axes + a];
                points.axes[a] = arrays[a].data();
            }
            const Points expected(coordinates, dimension);
            const Box box = bounding_box(points);
            EXPECT_EQ(box.lower, bounding_box(expected).lower);
            EXPECT_EQ(box.upper, bounding_box(expected).upper);
            const SupportMesh mesh = make_support_mesh(box, dimension, 3);
            EXPECT_EQ(test::all_collected(points).coordinates,
                      test::all_collected(expected).coordinates);
            const auto cells = cell_moments(points, mesh);
            const auto same = cell_moments(expected, mesh);
            ASSERT_EQ(cells.size(), same.size());
            for (std::size_t k = 0; k < cells.size(); ++k) {
                EXPECT_EQ(cells[k].moments.mean, same[k].moments.mean);
                EXPECT_EQ(cells[k].moments.deviation, same[k].moments.deviation);
            }
        }
    }
}

TEST(Points, bounding_box_tells_of_coordinates_that_are_no_numbers_at_any_stride) {
    for (const double bad : {std::nan(""), 1 / 0.0, -1 / 0.0}) {
        std::vector<double> values(11, 1.0);
        values[5] = bad;
        Points points;
        points.dimension = 1;
        points.count = 3;
        points.stride = 5 * sizeof(double);
        points.axes[0] = values.data();
        EXPECT_TRUE(std::isnan(bounding_box(points).lower[0]));
        EXPECT_TRUE(std::isnan(bounding_box(points).upper[0]));
    }
}

TEST(Points, bounding_box_of_no_points_is_empty) {
    const Box box = bounding_box(Points({}, 3));
    EXPECT_GT(box.lower[0], box.upper[0]);
}

TEST(Points, that_do_not_fit_their_arrays_have_no_box) {
    const std::vector<double> x(12);
    EXPECT_THROW(bounding_box(Points(std::span(x).first(11), 2)), Error);
    const std::vector<std::span<const double>> unequal{x, std::span(x).first(11)};
    EXPECT_THROW(bounding_box(Points(unequal)), Error);
    Points points(x, 2);
    EXPECT_EQ(bounding_box(points).upper[1], 0);
    points.count = std::numeric_limits<std::size_t>::max();
    EXPECT_THROW(bounding_box(points), Error);
    points.count = 6;
    for (const int dimension : {0, 3, 9}) {
        points.dimension = dimension;
        EXPECT_THROW(bounding_box(points), Error);
    }
}

}  // namespace
}  // namespace rrcb
