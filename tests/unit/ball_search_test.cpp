#include "lists/ball_search.hpp"

#include "../support/clouds.hpp"
#include "../support/distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace rrcb {
namespace {

using test::distance;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of few values, so that cuts and points often meet; some cuts have nothing on one side.
Cuts random_cuts(int dimension, int num_parts, std::mt19937_64& engine) {
    Cuts cuts{dimension, num_parts, {}, {}, {1 + num_parts % 3, num_parts % 2 == 0}};
    for (int k = 1; k < num_parts; ++k) {
        Cut cut;
        cut.axis = static_cast<std::int32_t>(engine() % static_cast<unsigned>(dimension));
        cut.at.fill(engine() % 2 == 0 ? -infinity : 4);
        const auto value = static_cast<double>(engine() % 10);
        const bool is_empty = engine() % 16 == 0;
        cut.at[static_cast<std::size_t>(cut.axis)] =
            is_empty ? (engine() % 2 == 0 ? infinity : -infinity) : value;
        cuts.tree.push_back(cut);
    }
    return cuts;
}

std::vector<Part> parts_found(const BallSearch& search, const Vector& x, double radius) {
    std::vector<Part> parts;
    search.for_each_part(
        Ball(x, radius), [&](Part part) { parts.push_back(part); },
        [](std::size_t node) { ADD_FAILURE() << "node " << node << " is known"; });
    return parts;
}

TEST(BallSearch, finds_the_parts_whose_boxes_are_within_the_radius) {
    std::mt19937_64 engine(11);
    std::size_t num_pairs = 0;
    std::size_t num_ties = 0;
    for (int round = 0; round < 600; ++round) {
        const int dimension = 1 + round % 3;
        const int num_parts = 1 + static_cast<int>(engine() % 40);
        const Cuts cuts = random_cuts(dimension, num_parts, engine);
        std::vector<char> is_wanted(static_cast<std::size_t>(num_parts));
        for (char& wanted : is_wanted) wanted = engine() % 4 != 0;
        const double radius = std::vector{0.0, 0.5, 1.0, 5.0, std::sqrt(2.0), 30.0}[engine() % 6];
        const BallSearch search(cuts, [&](Part part, const Box&) {
            return is_wanted[static_cast<std::size_t>(part)] == 0;
        });
        for (int k = 0; k < 100; ++k) {
            Vector x{};
            for (int a = 0; a < dimension; ++a)
                x[static_cast<std::size_t>(a)] = static_cast<double>(engine() % 20) / 2;
            std::vector<Part> expected;
            for (Part part = 0; part < num_parts; ++part) {
                const long double apart = distance(x, box_of(cuts, part), dimension);
                num_ties += apart == static_cast<long double>(radius) ? 1 : 0;
                if (is_wanted[static_cast<std::size_t>(part)] != 0 &&
                    apart <= radius * (1 + 1e-15L))
                    expected.push_back(part);
                ++num_pairs;
            }
            ASSERT_EQ(parts_found(search, x, radius), expected);
        }
    }
    EXPECT_GT(num_pairs, 1'000'000u);
    EXPECT_GT(num_ties, 10'000u);
}

/// One cut at 0: its parts are apart from a point as its coordinate is.
TEST(BallSearch, loses_no_part_by_rounding_and_finds_none_beyond_it) {
    const Cuts cuts{3, 2, {{0, 0, {0, -infinity, -infinity}}}};
    std::mt19937_64 engine(7);
    for (int k = 0; k < 100'000; ++k) {
        const double radius =
            std::ldexp(test::uniform(engine, 1, 2), static_cast<int>(engine() % 2000) - 1000);
        const BallSearch search(cuts, [](Part part, const Box&) { return part == 0; });
        EXPECT_EQ(parts_found(search, {-radius, 0, 0}, radius).size(), 1u);
        EXPECT_EQ(parts_found(search, {-std::nextafter(radius, 0), 0, 0}, radius).size(), 1u);
        EXPECT_EQ(parts_found(search, {-radius * (1 + 2e-15), 0, 0}, radius).size(), 0u);
    }
}

TEST(BallSearch, tells_the_interior_of_a_box_from_what_touches_its_sides) {
    const Box box{{0, 0, 0}, {4, infinity, 0}};
    EXPECT_TRUE(Ball({2, 2, 0}, 1).is_inside(box, 2));
    EXPECT_FALSE(Ball({1, 2, 0}, 1).is_inside(box, 2));
    EXPECT_FALSE(Ball({2, 1, 0}, 1).is_inside(box, 2));
    EXPECT_FALSE(Ball({3, 2, 0}, 1).is_inside(box, 2));
    EXPECT_FALSE(Ball({5, 2, 0}, 1).is_inside(box, 2));
    EXPECT_TRUE(Ball({2.5, 1e300, 0}, 1).is_inside(box, 2));
}

}  // namespace
}  // namespace rrcb
