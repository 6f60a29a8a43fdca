#include "paper/point_selection.hpp"

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "bisection/weighted_quantile.hpp"

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<MassPoint> points_on_axis(std::initializer_list<double> values) {
    std::vector<MassPoint> points;
    for (const double value : values) points.push_back({{value, 0, 0}, 1});
    return points;
}

struct Selected {
    std::size_t num_below;
    Cut cut;
};

Selected select(std::vector<MassPoint> points, int dimension, double target, bool plain = false,
                int axis = 0) {
    Selected selected{0, {axis, {}}};
    selected.num_below = select_below(points, dimension, target, plain, selected.cut);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_EQ(is_above(selected.cut, points[i].position, dimension), i >= selected.num_below);
    return selected;
}

TEST(SelectBelow, puts_the_cut_halfway_between_two_points) {
    const Selected selected = select(points_on_axis({7, 1, 4, 2}), 1, 2);
    EXPECT_EQ(selected.num_below, 2u);
    EXPECT_EQ(selected.cut.at[0], 3);
}

TEST(SelectBelow, puts_the_cut_on_a_point_that_the_target_divides_nearer_to_its_lower_end) {
    // 2.4 of 4: the third point stays above; 2.6: it goes below.
    EXPECT_EQ(select(points_on_axis({7, 1, 4, 2}), 1, 2.4).cut.at[0], 4);
    EXPECT_EQ(select(points_on_axis({7, 1, 4, 2}), 1, 2.6).cut.at[0], 5.5);
}

TEST(SelectBelow, takes_all_or_none_where_one_lot_holds_the_target) {
    EXPECT_EQ(select(points_on_axis({3, 3, 3, 3}), 1, 1).num_below, 0u);
    EXPECT_EQ(select(points_on_axis({3, 3, 3, 3}), 1, 3).num_below, 4u);
    EXPECT_EQ(select(points_on_axis({3, 3, 3, 3}), 1, 3).cut.at[0], infinity);
}

TEST(SelectBelow, divides_a_plane_along_the_other_axes_unless_it_is_to_be_plain) {
    std::vector<MassPoint> column;
    for (const double y : {4, 1, 3, 2}) column.push_back({{5, y, 0}, 1});
    const Selected tilted = select(column, 2, 2);
    EXPECT_EQ(tilted.num_below, 2u);
    EXPECT_EQ(tilted.cut.at, (Vector{5, 2.5, -infinity}));
    EXPECT_EQ(select(column, 2, 2, true).num_below, 4u);
}

/// Points of a small lattice and of a cloud, of weights of several decades and of none.
std::vector<MassPoint> random_points(std::mt19937_64& engine) {
    const auto count = 1 + engine() % 60;
    const bool on_lattice = engine() % 2 == 0;
    const bool weighted = engine() % 2 == 0;
    std::vector<MassPoint> points;
    for (std::size_t i = 0; i < count; ++i) {
        Vector x{};
        for (double& coordinate : x)
            coordinate = on_lattice ? static_cast<double>(engine() % 4) : test::uniform(engine);
        const double weight = weighted ? std::pow(10, test::uniform(engine, 0, 3)) : 1;
        points.push_back({x, weight});
    }
    return points;
}

TEST(SelectBelow, finds_the_cut_that_the_quantile_of_patches_without_extent_has) {
    std::mt19937_64 engine(17);
    for (int round = 0; round < 20000; ++round) {
        std::vector<MassPoint> points = random_points(engine);
        StatisticalDomain domain{3};
        double total = 0;
        for (const MassPoint& point : points) {
            domain.patches.push_back({point.position, point.position, point.weight});
            total += point.weight;
        }
        const int axis = static_cast<int>(engine() % 3);
        const double target = total * test::uniform(engine, 0.01, 0.99);
        const bool plain = engine() % 4 == 0;
        const Cut expected = weighted_quantile(Profile(domain), axis, target, plain);
        const Selected selected = select(points, 3, target, plain, axis);
        EXPECT_EQ(selected.cut.at, expected.at) << "round " << round;
    }
}

}  // namespace
}  // namespace rrcb
