// The checksum by which a repeated call knows its objects and their parts again.
#include "../support/common.hpp"
#include "zoltan/call/kept_objects_mpi.hpp"

namespace rrcb::zoltan {
namespace {

struct Object {
    double x, y, weight;
    Part part;
};

std::uint64_t sum_of(const std::vector<Object>& objects) {
    std::vector<double> coordinates, weights;
    std::vector<Part> parts;
    for (const Object& object : objects) {
        coordinates.insert(coordinates.end(), {object.x, object.y});
        weights.push_back(object.weight);
        parts.push_back(object.part);
    }
    return checksum_of(Points(coordinates, 2, weights), parts);
}

TEST(Checksum, adds_up_over_ranks_in_any_order) {
    const Object a{1, 2, 3, 0}, b{0.5, -1, 1, 4}, c{1e-300, 7, 2, 4};
    EXPECT_EQ(sum_of({a, b, c}), sum_of({c, a}) + sum_of({b}));
    EXPECT_EQ(sum_of(std::vector<Object>{}), 0U);
    EXPECT_NE(sum_of({a, a}), sum_of({a}));
}

TEST(Checksum, differs_between_objects_of_simple_numbers) {
    std::set<std::uint64_t> sums;
    std::size_t count = 0;
    for (const double x : {0.0, 0.5, 1.0, 2.0, -1.0, 4.0, 0.25})
        for (const double y : {0.0, 0.5, 1.0, 2.0, -1.0, 4.0, 0.25})
            for (const double weight : {0.0, 0.5, 1.0, 2.0, 4.0})
                for (Part part = 0; part < 40; ++part, ++count)
                    sums.insert(sum_of({{x, y, weight, part}}));
    EXPECT_EQ(sums.size(), count);
}

TEST(Checksum, tells_weights_positions_and_parts_that_changed_places) {
    const auto sum = sum_of({{1, 2, 4, 0}, {2, 1, 1, 1}});
    EXPECT_NE(sum_of({{1, 2, 1, 0}, {2, 1, 4, 1}}), sum);
    EXPECT_NE(sum_of({{1, 1, 4, 0}, {2, 2, 1, 1}}), sum);
    EXPECT_NE(sum_of({{1, 2, 4, 1}, {2, 1, 1, 0}}), sum);
    EXPECT_NE(sum_of({{2, 1, 4, 0}, {1, 2, 1, 1}}), sum);
}

}  // namespace
}  // namespace rrcb::zoltan
