#include "../support/common.hpp"
#include "arithmetic/position_order.hpp"
#include "estimate/kept_tree.hpp"
#include "passes/summary.hpp"

#include <rrcb/error.hpp>

namespace rrcb {
namespace {

std::vector<double> lattice_cloud(std::size_t count, int dimension, int width) {
    std::mt19937_64 engine(count);
    std::vector<double> coordinates(count * static_cast<std::size_t>(dimension));
    for (double& x : coordinates)
        x = static_cast<double>(engine() % static_cast<unsigned>(width)) - 2;
    return coordinates;
}

void expect_ends(const Points& points, const PointSummary& extent) {
    for (int axis = 0; axis < points.dimension; ++axis) {
        std::vector<Vector> positions;
        for (LocalIndex i = 0; i < points.count; ++i) positions.push_back(points.position(i));
        std::ranges::sort(positions, PositionOrder(axis, 0, points.dimension));
        for (std::size_t a = 0; a < static_cast<std::size_t>(points.dimension); ++a) {
            EXPECT_EQ(extent.first[static_cast<std::size_t>(axis)][a], positions.front()[a]);
            EXPECT_EQ(extent.last[static_cast<std::size_t>(axis)][a], positions.back()[a]);
        }
    }
}

TEST(Extent, has_the_first_and_last_position_in_the_order_across_each_axis) {
    for (const int dimension : {1, 2, 3}) {
        for (const std::size_t count : {1u, 2u, 255u, 256u, 257u, 1000u}) {
            for (const int width : {1, 3, 100}) {
                const auto coordinates = lattice_cloud(count, dimension, width);
                const Points points(coordinates, dimension);
                expect_ends(points, summary_of(points));
            }
        }
    }
}

TEST(Extent, is_the_same_for_columns_and_members_of_structs) {
    const auto coordinates = lattice_cloud(600, 3, 5);
    Points of_structs(coordinates, 3);
    of_structs.dimension = 2;
    expect_ends(of_structs, summary_of(of_structs));
    const std::array<std::span<const double>, 2> columns{std::span(coordinates).first(600),
                                                         std::span(coordinates).last(600)};
    const Points of_columns(columns);
    expect_ends(of_columns, summary_of(of_columns));
}

TEST(Extent, of_two_is_that_of_their_points_together) {
    const auto coordinates = lattice_cloud(90, 3, 4);
    const std::span all(coordinates);
    PointSummary both = summary_of(Points(all.first(120), 3));
    join(both, summary_of(Points(all.subspan(120), 3)), 3);
    join(both, PointSummary{}, 3);
    EXPECT_EQ(both.count, 90);
    EXPECT_EQ(both.weight, 90);
    expect_ends(Points(all, 3), both);
}

TEST(Extent, travels_as_doubles) {
    const auto coordinates = lattice_cloud(50, 2, 9);
    PointSummary extent = summary_of(Points(coordinates, 2));
    extent.weight = 12.5;
    std::vector<double> doubles;
    append_extent(extent, 2, doubles);
    append_extent(PointSummary{}, 2, doubles);
    EXPECT_EQ(doubles.size(), 20u);
    const std::vector<PointSummary> extents = read_extents(doubles, 2);
    ASSERT_EQ(extents.size(), 2u);
    EXPECT_EQ(extents[0].count, 50);
    EXPECT_EQ(extents[0].weight, 12.5);
    expect_ends(Points(coordinates, 2), extents[0]);
    EXPECT_EQ(extents[1].count, 0);
    PointSummary still_empty = extents[1];
    join(still_empty, extents[0], 2);
    expect_ends(Points(coordinates, 2), still_empty);
}

TEST(PointSummary, reads_weights_and_refuses_the_first_illegal_value) {
    std::vector<double> coordinates = lattice_cloud(600, 2, 9);
    std::vector<double> weights(600, 2.5);
    weights[3] = 0.5;
    weights[599] = 7;
    const auto summary = [&] { return summary_of(Points(coordinates, 2, weights)); };
    EXPECT_EQ(summary().lightest, 0.5);
    EXPECT_EQ(summary().heaviest, 7);
    EXPECT_EQ(summary().weight, 598 * 2.5 + 7.5);
    EXPECT_EQ(summary().box.lower, bounding_box(Points(coordinates, 2)).lower);
    EXPECT_EQ(summary().box.upper, bounding_box(Points(coordinates, 2)).upper);
    const auto text_for = [&](double& value, double illegal) -> std::string {
        const double legal = std::exchange(value, illegal);
        std::string text;
        try {
            summary();
        } catch (const Error& error) {
            text = error.what();
        }
        value = legal;
        return text;
    };
    for (const double illegal : {-1.0, double(NAN), HUGE_VAL})
        EXPECT_NE(text_for(weights[300], illegal).find("weight of point 300"), std::string::npos);
    weights[7] = 1e308;
    EXPECT_NE(text_for(weights[300], 1e308).find("overflows"), std::string::npos);
    for (const double illegal : {double(NAN), -HUGE_VAL})
        EXPECT_NE(text_for(coordinates[803], illegal).find("coordinate of point 401 on axis 1"),
                  std::string::npos);
}

}  // namespace
}  // namespace rrcb
