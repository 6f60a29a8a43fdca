// Parts of points and what they hold, in one pass, beside the look-up of every point.
#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "passes/assignment.hpp"

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Cuts at coordinates of points, so that many points lie on them; every third one breaks ties.
Cuts cuts_at_points(const Points& points, int num_parts, std::mt19937_64& engine) {
    Cuts cuts{points.dimension, num_parts, {}};
    for (int k = 0; k + 1 < num_parts; ++k) {
        Cut cut;
        cut.axis = static_cast<std::int32_t>(engine() % static_cast<unsigned>(points.dimension));
        cut.at.fill(-infinity);
        const Vector x = points.position(engine() % points.count);
        if (k % 3 == 0) cut.at = x;
        cut.at[static_cast<std::size_t>(cut.axis)] = x[static_cast<std::size_t>(cut.axis)];
        cuts.tree.push_back(cut);
    }
    return cuts;
}

std::vector<double> lattice(std::size_t count, int dimension, std::mt19937_64& engine) {
    std::vector<double> coordinates;
    for (std::size_t i = 0; i < count * static_cast<std::size_t>(dimension); ++i)
        coordinates.push_back(static_cast<double>(engine() % 9) - 4);
    return coordinates;
}

void expect_as_looked_up(const Cuts& cuts, const Points& points) {
    std::vector<Part> parts(points.count);
    const EndTotals totals = assign_and_count(cuts, points, parts);
    std::vector<double> weights(static_cast<std::size_t>(cuts.num_parts));
    std::vector<double> counts(weights.size());
    for (LocalIndex i = 0; i < points.count; ++i) {
        const Part expected = part_of(cuts, points.position(i));
        ASSERT_EQ(parts[i], expected) << "point " << i << ", " << cuts.num_parts << " parts";
        weights[static_cast<std::size_t>(expected)] += points.weight(i);
        counts[static_cast<std::size_t>(expected)] += 1;
    }
    EXPECT_TRUE(totals.all_finite);
    EXPECT_EQ(totals.counts, counts);
    ASSERT_EQ(totals.weights.size(), weights.size());
    for (std::size_t p = 0; p < weights.size(); ++p)
        EXPECT_NEAR(totals.weights[p], weights[p], 1e-12 * weights[p]);
    std::vector<Part> alone(points.count);
    assign(cuts, points, alone);
    EXPECT_EQ(alone, parts);
}

TEST(DirectAssignment, finds_the_parts_of_the_look_up_and_counts_them) {
    std::mt19937_64 engine(3);
    for (const int dimension : {1, 2, 3})
        for (const int num_parts : {1, 2, 3, 5, 8, 9, 31, 100})
            for (const std::size_t count : {1u, 511u, 2050u}) {
                const std::vector<double> coordinates = lattice(count, dimension, engine);
                std::vector<double> weights;
                for (std::size_t i = 0; i < count; ++i) weights.push_back(test::uniform(engine));
                const Points points(coordinates, dimension);
                const Cuts cuts = cuts_at_points(points, num_parts, engine);
                expect_as_looked_up(cuts, points);
                expect_as_looked_up(cuts, Points(coordinates, dimension, weights));
            }
}

TEST(DirectAssignment, reads_any_layout) {
    std::mt19937_64 engine(4);
    const std::vector<double> x = lattice(1000, 1, engine);
    const std::vector<double> y = lattice(1000, 1, engine);
    const std::array<std::span<const double>, 2> columns{x, y};
    const Points by_columns(columns);
    expect_as_looked_up(cuts_at_points(by_columns, 12, engine), by_columns);
    const std::vector<double> members = lattice(1000, 5, engine);
    Points strided({}, 2);
    strided.count = 1000;
    strided.stride = 5 * sizeof(double);
    strided.axes = {members.data(), members.data() + 3, nullptr};
    expect_as_looked_up(cuts_at_points(strided, 12, engine), strided);
}

TEST(DirectAssignment, keeps_to_cuts_at_infinity_and_to_the_ends_of_the_doubles) {
    const double largest = std::numeric_limits<double>::max();
    const double smallest = std::numeric_limits<double>::denorm_min();
    const std::vector<double> values{-largest, -smallest, -0.0, 0.0, smallest, largest};
    for (const double plane : {-infinity, -largest, -smallest, 0.0, smallest, largest, infinity}) {
        Cut cut;
        cut.at = {plane, -infinity, -infinity};
        expect_as_looked_up({1, 2, {cut}}, Points(values, 1));
    }
}

TEST(DirectAssignment, notices_each_coordinate_that_is_not_finite) {
    const Cuts cuts{3, 2, {Cut{2, 0, {-infinity, -infinity, 0.5}}}};
    for (const double bad : {infinity, -infinity, std::nan(""), -std::nan("")}) {
        for (const std::size_t at : {0u, 1u, 2u, 1534u, 2099u}) {
            std::vector<double> coordinates(2100, 1e308);
            std::vector<Part> parts(700);
            coordinates[at] = bad;
            EXPECT_FALSE(assign_and_count(cuts, Points(coordinates, 3), parts).all_finite);
        }
    }
}

TEST(DirectAssignment, of_no_points_counts_nothing) {
    const Cuts cuts{2, 3, {Cut{}, Cut{}}};
    Points none;
    none.dimension = 2;
    const EndTotals totals = assign_and_count(cuts, none, {});
    EXPECT_EQ(totals.counts, std::vector<double>(3, 0.0));
    EXPECT_EQ(totals.weights, std::vector<double>(3, 0.0));
    EXPECT_TRUE(totals.all_finite);
}

}  // namespace
}  // namespace rrcb
