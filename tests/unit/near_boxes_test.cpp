#include "lists/near_boxes.hpp"

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "../support/distance.hpp"
#include "lists/periodic_images.hpp"
#include "lists/quiet_boxes.hpp"

namespace rrcb {
namespace {

using test::distance;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of few values, so that cuts and points often meet; some cuts have nothing on one side.
Cuts random_cuts(int dimension, int num_parts, std::mt19937_64& engine) {
    Cuts cuts{dimension, num_parts, {}, {1 + num_parts % 3, num_parts % 2 == 0}};
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

/// Box of all positions of random points.
constexpr Box all_points{{0, 0, 0}, {10, 10, 10}};

/// Rank 0 is this one.
NearRequest request(double radius, const Box& points, const std::vector<int>& ranks) {
    return {[&](Part end) {
                return RankRange{ranks[static_cast<std::size_t>(end)], 1};
            },
            0, points, radius};
}

template <int dimension>
std::vector<Part> parts_found(const NearBoxes& near, const Vector& x, double radius) {
    std::vector<Part> parts;
    near.for_each_touched<dimension>(Ball(x, radius), [&](const NearBoxes::Row& row) {
        EXPECT_EQ(row.num_slots, 1);
        parts.push_back(row.end);
    });
    return parts;
}

std::vector<Part> parts_found(const NearBoxes& near, const Vector& x, double radius,
                              int dimension) {
    if (dimension == 1) return parts_found<1>(near, x, radius);
    if (dimension == 2) return parts_found<2>(near, x, radius);
    return parts_found<3>(near, x, radius);
}

std::vector<LocalIndex> outside(const QuietBoxes& quiet, const Points& points) {
    std::vector<LocalIndex> found;
    quiet.for_each_outside(points, [&](LocalIndex i) { found.push_back(i); });
    return found;
}

/// Cuts, the rank of each part, and a radius.
struct Case {
    int dimension;
    Cuts cuts;
    std::vector<int> ranks;
    double radius;
};

Case random_case(int number, std::mt19937_64& engine) {
    Case random{1 + number % 3, {}, {}, 0};
    const int num_parts = 1 + static_cast<int>(engine() % 40);
    random.cuts = random_cuts(random.dimension, num_parts, engine);
    const unsigned num_here = 1 + static_cast<unsigned>(engine() % 4);
    for (int part = 0; part < num_parts; ++part)
        random.ranks.push_back(engine() % 4 < num_here ? 0 : 1 + static_cast<int>(engine() % 5));
    random.radius = std::vector{0.0, 0.5, 1.0, 5.0, std::sqrt(2.0), 30.0}[engine() % 6];
    return random;
}

/// Interleaved multiples of a half.
std::vector<double> random_points(std::size_t count, int dimension, std::mt19937_64& engine) {
    std::vector<double> coordinates(count * static_cast<std::size_t>(dimension));
    for (double& x : coordinates) x = static_cast<double>(engine() % 20) / 2;
    return coordinates;
}

/// Returns the parts of other ranks whose boxes are within a distance; counts those exactly at it.
std::vector<Part> parts_within(const Case& random, const Vector& x, std::size_t& num_ties) {
    std::vector<Part> parts;
    for (Part part = 0; part < random.cuts.num_parts; ++part) {
        const long double apart = distance(x, box_of(random.cuts, part), random.dimension);
        num_ties += apart == static_cast<long double>(random.radius) ? 1 : 0;
        if (random.ranks[static_cast<std::size_t>(part)] != 0 &&
            apart <= random.radius * (1 + 1e-15L))
            parts.push_back(part);
    }
    return parts;
}

TEST(NearBoxes, are_the_boxes_of_other_ranks_within_the_radius) {
    std::mt19937_64 engine(11);
    std::size_t num_found = 0;
    std::size_t num_ties = 0;
    for (int number = 0; number < 1200; ++number) {
        const Case random = random_case(number, engine);
        auto coordinates = random_points(100, random.dimension, engine);
        // Every other time the points are in a part of space, which a request tells by their box.
        const bool is_narrow = number % 2 == 1;
        if (is_narrow)
            for (double& x : coordinates) x = x / 4 + 3;
        const Points points(coordinates, random.dimension);
        const Box box = is_narrow ? bounding_box(points) : all_points;
        const NearBoxes near(random.cuts, request(random.radius, box, random.ranks));
        for (LocalIndex i = 0; i < points.count; ++i) {
            const Vector x = points.position(i);
            const std::vector<Part> expected = parts_within(random, x, num_ties);
            ASSERT_EQ(parts_found(near, x, random.radius, random.dimension), expected);
            num_found += is_narrow ? 0 : expected.size();
        }
    }
    EXPECT_GT(num_found, 60'000u);
    EXPECT_GT(num_ties, 10'000u);
}

/// One cut at 0: its parts are apart from a point as its coordinate is.
TEST(NearBoxes, lose_no_part_by_rounding_and_have_none_beyond_it) {
    const Cuts cuts{3, 2, {{0, 0, {0, -infinity, -infinity}}}};
    const std::vector<int> ranks{0, 1};
    std::mt19937_64 engine(7);
    for (int k = 0; k < 100'000; ++k) {
        const double radius =
            std::ldexp(test::uniform(engine, 1, 2), static_cast<int>(engine() % 2000) - 1000);
        const Box points{{-2 * radius, 0, 0}, {0, 0, 0}};
        const NearBoxes near(cuts, request(radius, points, ranks));
        EXPECT_EQ(parts_found<3>(near, {-radius, 0, 0}, radius).size(), 1u);
        EXPECT_EQ(parts_found<3>(near, {-std::nextafter(radius, 0), 0, 0}, radius).size(), 1u);
        EXPECT_EQ(parts_found<3>(near, {-radius * (1 + 2e-15), 0, 0}, radius).size(), 0u);
    }
}

TEST(QuietBoxes, hold_no_point_near_another_rank_and_most_others) {
    std::mt19937_64 engine(13);
    std::size_t num_outside = 0;
    std::size_t num_near = 0;
    std::size_t num_ties = 0;
    for (int number = 0; number < 600; ++number) {
        const Case random = random_case(number, engine);
        const NearBoxes near(random.cuts, request(random.radius, all_points, random.ranks));
        const QuietBoxes quiet(near.homes(), random.radius, random.dimension);
        const auto coordinates = random_points(600, random.dimension, engine);
        const Points points(coordinates, random.dimension);
        const std::vector<LocalIndex> found = outside(quiet, points);
        num_outside += found.size();
        for (LocalIndex i = 0; i < points.count; ++i) {
            if (parts_within(random, points.position(i), num_ties).empty()) continue;
            ++num_near;
            ASSERT_TRUE(std::ranges::binary_search(found, i));
        }
    }
    EXPECT_GT(num_near, 100'000u);
    // The points of other ranks are outside, too.
    EXPECT_LT(num_outside, num_near + num_near / 4);
}

TEST(QuietBoxes, leave_out_little_more_than_the_radius_at_any_scale) {
    std::mt19937_64 engine(5);
    for (int k = 0; k < 20'000; ++k) {
        const auto scale = [&] { return static_cast<int>(engine() % 600) - 300; };
        const double lower = std::ldexp(test::uniform(engine, -1, 1), scale());
        const double radius = k % 8 == 0 ? 0 : std::ldexp(test::uniform(engine), scale());
        const std::vector<Box> homes{{{lower, 0, 0}, {infinity, 0, 0}}};
        const QuietBoxes quiet(homes, radius, 1);
        const auto is_quiet = [&](double x) {
            return outside(quiet, Points(std::vector{x}, 1)).empty();
        };
        const double margin =
            12 * std::numeric_limits<double>::epsilon() * std::max(std::abs(lower), radius);
        EXPECT_TRUE(is_quiet(lower + radius + margin));
        for (const double x : {lower, lower + radius, std::nextafter(lower + radius, infinity),
                               lower + radius + margin / 4})
            EXPECT_TRUE(!is_quiet(x) || Ball({x, 0, 0}, radius).is_inside(homes[0], 1));
    }
}

TEST(QuietBoxes, hold_no_point_with_an_image_near_the_periodic_box) {
    std::mt19937_64 engine(17);
    for (int k = 0; k < 20'000; ++k) {
        const double lower = std::ldexp(test::uniform(engine, -1, 1), static_cast<int>(k % 60));
        const Box box{{lower, -infinity, 0}, {lower + test::uniform(engine, 1, 2), infinity, 0}};
        if (!(box.lower[0] < box.upper[0])) continue;
        const PeriodicImages images(box, 2);
        const double radius = test::uniform(engine, 0, 0.6);
        const std::vector<Box> homes{box};
        const QuietBoxes quiet(homes, radius, 2, &images);
        for (const double from : {box.lower[0] + radius, box.upper[0] - radius})
            for (int step = -3; step <= 3; ++step) {
                const double x =
                    std::clamp(from + step * std::abs(from) * 0x1p-52, box.lower[0], box.upper[0]);
                const std::vector<double> one{x, 0};
                if (!outside(quiet, Points(one, 2)).empty()) continue;
                int number = 0;
                images.for_each(Ball({x, 0, 0}, radius),
                                [&](const Shift&, const Vector&) { ++number; });
                EXPECT_EQ(number, 1);
            }
    }
}

TEST(Ball, tells_the_interior_of_a_box_from_what_touches_its_sides) {
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
