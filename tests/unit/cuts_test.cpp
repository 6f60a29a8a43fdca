#include "../support/common.hpp"

#include <rrcb/cuts.hpp>
#include <rrcb/error.hpp>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// x = 4 first; below it y = 1; above it y = 3 for two parts more.
Cuts four_quarters() {
    Cuts cuts{2, 4, {}};
    cuts.tree = {{0, 0, {4, -infinity, -infinity}},
                 {1, 0, {-infinity, 1, -infinity}},
                 {1, 0, {-infinity, 3, -infinity}}};
    return cuts;
}

Box box_2d(double x0, double y0, double x1, double y1) {
    Box box;
    box.lower = {x0, y0, 0};
    box.upper = {x1, y1, 0};
    return box;
}

TEST(Cuts, a_point_on_a_cut_is_above_it) {
    const Cuts cuts = four_quarters();
    EXPECT_EQ(part_of(cuts, {4, 2, 0}), 2);
    EXPECT_EQ(part_of(cuts, {4, 3, 0}), 3);
    EXPECT_EQ(part_of(cuts, {3.9, 1, 0}), 1);
    EXPECT_EQ(part_of(cuts, {3.9, 0.9, 0}), 0);
}

TEST(Cuts, ties_are_broken_along_the_other_axes) {
    const Cut cut{1, 0, {5, 2, 7}};
    EXPECT_TRUE(is_above(cut, {0, 2.1, 0}, 3));
    EXPECT_FALSE(is_above(cut, {9, 1.9, 9}, 3));
    EXPECT_TRUE(is_above(cut, {6, 2, 0}, 3));
    EXPECT_FALSE(is_above(cut, {4, 2, 9}, 3));
    EXPECT_TRUE(is_above(cut, {5, 2, 7}, 3));
    EXPECT_FALSE(is_above(cut, {5, 2, 6}, 3));
    EXPECT_TRUE(is_above(cut, {5, 2, 0}, 2));
}

TEST(Cuts, box_of_a_part_is_open_outwards) {
    const Cuts cuts = four_quarters();
    const Box box = box_of(cuts, 2);
    EXPECT_EQ(box.lower[0], 4);
    EXPECT_EQ(box.upper[0], infinity);
    EXPECT_EQ(box.lower[1], -infinity);
    EXPECT_EQ(box.upper[1], 3);
}

TEST(Cuts, a_box_touches_both_sides_of_a_cut_that_divides_the_points_in_it) {
    Cuts cuts{2, 2, {{0, 0, {4, 2, -infinity}}}};
    EXPECT_EQ(parts_touching(cuts, box_2d(4, 2, 4, 2)), (std::vector<Part>{1}));
    cuts.tree[0].divides = 1;
    EXPECT_EQ(parts_touching(cuts, box_2d(4, 2, 4, 2)), (std::vector<Part>{0, 1}));
    EXPECT_EQ(parts_touching(cuts, box_2d(4, 2.5, 5, 3)), (std::vector<Part>{1}));
}

TEST(Cuts, a_box_touches_the_parts_it_reaches_into) {
    const Cuts cuts = four_quarters();
    EXPECT_EQ(parts_touching(cuts, box_2d(0, 0, 1, 0.5)), (std::vector<Part>{0}));
    EXPECT_EQ(parts_touching(cuts, box_2d(0, 0, 1, 1)), (std::vector<Part>{0, 1}));
    EXPECT_EQ(parts_touching(cuts, box_2d(3, 0, 4, 2)), (std::vector<Part>{0, 1, 2}));
    EXPECT_EQ(parts_touching(cuts, box_2d(-9, -9, 9, 9)), (std::vector<Part>{0, 1, 2, 3}));
    EXPECT_TRUE(parts_touching(cuts, Box{}).empty());
}

TEST(Cuts, one_part_takes_everything) {
    EXPECT_EQ(part_of({2, 1, {}}, {1e300, -1e300, 0}), 0);
    EXPECT_EQ(box_of({2, 1, {}}, 0).lower[1], -infinity);
}

/// Cuts at whole numbers, some of which break ties at 4 or have nothing on one side.
Cuts random_cuts(int dimension, int num_parts, bool is_plain, std::mt19937_64& engine) {
    const std::vector<double> values{-infinity, 0, 1, 2, 3, 4, 5, infinity};
    Cuts cuts{dimension, num_parts, {}, {1 + num_parts % 3, num_parts % 2 == 0}};
    for (int k = 1; k < num_parts; ++k) {
        Cut cut;
        cut.axis = static_cast<std::int32_t>(engine() % static_cast<unsigned>(dimension));
        cut.at.fill(is_plain || engine() % 2 == 0 ? -infinity : 4);
        cut.at[static_cast<std::size_t>(cut.axis)] = values[engine() % values.size()];
        cuts.tree.push_back(cut);
    }
    return cuts;
}

/// Whether each part takes a position of a lattice so fine that some lies between any two cuts.
std::vector<bool> take_positions(const Cuts& cuts) {
    std::vector<bool> take(static_cast<std::size_t>(cuts.num_parts));
    const auto end = [&](int axis) { return cuts.dimension > axis ? 6.0 : -0.5; };
    for (double x = -0.5; x < 6; x += 0.5)
        for (double y = -0.5; y <= end(1); y += 0.5)
            for (double z = -0.5; z <= end(2); z += 0.5)
                take[static_cast<std::size_t>(part_of(cuts, {x, y, z}))] = true;
    return take;
}

TEST(Cuts, the_box_of_a_part_is_empty_if_no_position_is_in_it) {
    std::mt19937_64 engine(5);
    int num_empty = 0;
    for (int round = 0; round < 400; ++round) {
        const int dimension = 1 + round % 3;
        const bool is_plain = round % 2 == 0;
        const Cuts cuts = random_cuts(dimension, 2 + round % 20, is_plain, engine);
        const std::vector<bool> take = take_positions(cuts);
        const std::vector<Part> touched = parts_touching(
            cuts, {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}});
        for (Part part = 0; part < cuts.num_parts; ++part) {
            const Box box = box_of(cuts, part);
            const bool is_empty = box.lower == Box{}.lower && box.upper == Box{}.upper;
            const bool takes = take[static_cast<std::size_t>(part)];
            EXPECT_FALSE(takes && is_empty);
            // Ties may leave nothing where cuts across several axes meet, which no box shows.
            EXPECT_TRUE(is_empty || takes || !(is_plain || dimension == 1));
            for (std::size_t a = 0; a < static_cast<std::size_t>(dimension) && !is_empty; ++a)
                EXPECT_LE(box.lower[a], box.upper[a]);
            EXPECT_EQ(std::ranges::find(touched, part) == touched.end(), is_empty);
            num_empty += is_empty ? 1 : 0;
        }
    }
    EXPECT_GT(num_empty, 500);
}

TEST(Cuts, the_box_of_a_part_that_has_some_of_the_points_in_one_place_holds_that_place) {
    // Of the points at (1, 2) some are in each of four parts.
    const Cut cut{0, 1, {1, 2, -infinity}};
    const Cuts cuts{2, 4, {cut, cut, cut}};
    for (Part part = 0; part < 4; ++part) {
        const Box box = box_of(cuts, part);
        EXPECT_LE(box.lower[0], 1);
        EXPECT_GE(box.upper[0], 1);
    }
    EXPECT_EQ(parts_touching(cuts, box_2d(1, 2, 1, 2)), (std::vector<Part>{0, 1, 2, 3}));
}

TEST(Cuts, look_ups_that_would_leave_an_array_are_refused) {
    const Cuts cuts = four_quarters();
    for (const Part part : {-1, 4, 1000}) EXPECT_THROW(box_of(cuts, part), Error);
    std::vector<Cuts> broken(7, cuts);
    broken[0].tree.pop_back();
    broken[1].dimension = 9;
    broken[2].dimension = 0;
    broken[3].num_parts = 0;
    broken[4].tree[0].axis = 2;
    broken[5].shape = {0, false, 1};
    broken[6].shape = {3, false, 2};
    const std::vector<double> x(12, 0.5);
    std::vector<Part> parts(6);
    for (const Cuts& wrong : broken) {
        EXPECT_THROW(box_of(wrong, 0), Error);
        EXPECT_THROW(parts_touching(wrong, box_2d(0, 0, 9, 9)), Error);
        EXPECT_THROW(assign(wrong, Points(x, 2), parts), Error);
    }
    EXPECT_THROW(assign(cuts, Points(x, 2), std::span(parts).first(5)), Error);
    EXPECT_THROW(assign(cuts, Points(x, 1), parts), Error);
    EXPECT_THROW(assign(cuts, Points(x, 3), std::span(parts).first(4)), Error);
    const std::array<std::span<const double>, 2> columns{x, std::span(x).first(5)};
    std::vector<Part> many(12);
    EXPECT_THROW(assign(cuts, Points(columns), many), Error);
    assign(cuts, Points(x, 2), parts);
    EXPECT_EQ(parts, (std::vector<Part>(6, 0)));
}

TEST(Cuts, look_ups_of_what_is_no_position_are_refused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Cuts cuts = four_quarters();
    for (const double bad : {nan, infinity, -infinity})
        for (const std::size_t at : {0u, 777u, 1999u}) {
            std::vector<double> x(2000);
            std::vector<Part> parts(1000);
            x[at] = bad;
            EXPECT_THROW(assign(cuts, Points(x, 2), parts), Error);
        }
    EXPECT_EQ(part_of(cuts, {nan, 2, 0}), no_part);
    EXPECT_EQ(part_of(cuts, {4, nan, 0}), no_part);
    EXPECT_EQ(part_of(cuts, {infinity, 2, nan}), 2);
    EXPECT_THROW(parts_touching(cuts, box_2d(0, nan, 1, 1)), Error);
}

}  // namespace
}  // namespace rrcb
