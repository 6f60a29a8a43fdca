// The moments against long double for every offset, extent, shape and number of points.
#include "../support/clouds.hpp"
#include "moments_reference.hpp"

namespace rrcb {
namespace {

/// Coordinate of point i of `count` in the unit interval.
using Shape = double (*)(std::size_t i, std::size_t count, std::mt19937_64& engine);

struct Cloud {
    const char* name;
    Shape coordinate;
};

constexpr Cloud clouds[] = {
    {"uniform", [](std::size_t, std::size_t, std::mt19937_64& e) { return test::uniform(e); }},
    {"equal", [](std::size_t, std::size_t, std::mt19937_64&) { return 0.7; }},
    {"two_values",
     [](std::size_t i, std::size_t, std::mt19937_64&) { return i % 3 == 0 ? 0.1 : 0.8; }},
    {"far_outlier_first",
     [](std::size_t i, std::size_t, std::mt19937_64& e) {
         return i == 0 ? 1.0 : 1e-9 * test::uniform(e);
     }},
    {"far_outlier_last",
     [](std::size_t i, std::size_t count, std::mt19937_64& e) {
         return i + 1 == count ? 1.0 : 1e-9 * test::uniform(e);
     }},
};

std::vector<double> make(const Cloud& cloud, std::size_t count, double offset, double extent) {
    std::mt19937_64 engine(count);
    std::vector<double> x(count);
    for (std::size_t i = 0; i < count; ++i)
        x[i] = offset + extent * cloud.coordinate(i, count, engine);
    return x;
}

class MomentsOf : public testing::TestWithParam<Cloud> {};

std::string name_of_cloud(const testing::TestParamInfo<Cloud>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Cloud, MomentsOf, testing::ValuesIn(clouds), name_of_cloud);

void expect_reference(const std::vector<double>& x, int cells, std::span<const double> w = {}) {
    const std::array<std::span<const double>, 1> columns{x};
    test::expect_reference_moments(Points(columns, w), cells);
}

TEST_P(MomentsOf, match_at_every_offset_and_number_of_points) {
    for (const double offset : {0.0, 1.0, -1e3, 1e6, 1e9, 1e12, 1e15}) {
        for (const std::size_t count : {1, 2, 3, 10, 1000, 30000}) {
            SCOPED_TRACE("offset " + std::to_string(offset) + ", points " + std::to_string(count));
            expect_reference(make(GetParam(), count, offset, 1), 1);
            expect_reference(make(GetParam(), count, offset, 1e-3), 3);
        }
    }
}

TEST_P(MomentsOf, match_at_every_extent) {
    for (int exponent = -300; exponent <= 300; exponent += 20) {
        const double extent = std::pow(10.0, exponent);
        SCOPED_TRACE("extent 1e" + std::to_string(exponent));
        expect_reference(make(GetParam(), 500, 0, extent), 1);
        expect_reference(make(GetParam(), 500, -extent / 3, extent), 4);
        expect_reference(make(GetParam(), 500, 1e6 * extent, extent), 1);
    }
}

TEST_P(MomentsOf, match_with_weights_over_sixty_decades) {
    std::mt19937_64 engine(3);
    std::vector<double> weights(2000);
    for (double& weight : weights) weight = std::pow(10.0, test::uniform(engine, -30, 30));
    for (const double offset : {0.0, 1e9})
        expect_reference(make(GetParam(), weights.size(), offset, 1), 2, weights);
}

TEST_P(MomentsOf, match_for_ten_million_points_in_one_cell) {
    expect_reference(make(GetParam(), 10'000'000, 1e6, 1), 1);
}

Moments moments_of(std::span<const double> x) {
    const std::array<std::span<const double>, 1> columns{x};
    const Points points(columns);
    return cell_moments(points, make_support_mesh(bounding_box(points), 1, 1))[0].moments;
}

/// Pieces of unequal length that make up the points.
std::vector<Moments> pieces_of(const std::vector<double>& x) {
    std::vector<Moments> pieces;
    std::size_t first = 0;
    for (std::size_t length = 1; first < x.size(); length = 3 * length / 2 + 1) {
        const std::size_t last = std::min(first + length, x.size());
        pieces.push_back(moments_of({x.data() + first, last - first}));
        first = last;
    }
    return pieces;
}

Moments merge_in_pairs(std::span<const Moments> pieces) {
    if (pieces.size() == 1) return pieces[0];
    const std::size_t half = pieces.size() / 2;
    return merge(merge_in_pairs(pieces.first(half)), merge_in_pairs(pieces.subspan(half)));
}

TEST_P(MomentsOf, merge_alike_in_any_order_and_grouping) {
    std::mt19937_64 engine(5);
    for (const double extent : {1e-300, 1.0, 1e300}) {
        const std::vector<double> x = make(GetParam(), 3000, 0, extent);
        const Moments whole = moments_of(x);
        std::vector<Moments> pieces = pieces_of(x);
        ASSERT_GT(pieces.size(), 10u);
        for (int round = 0; round < 50; ++round) {
            for (std::size_t i = pieces.size() - 1; i > 0; --i)
                std::swap(pieces[i], pieces[engine() % (i + 1)]);
            const Moments chain = std::accumulate(pieces.begin(), pieces.end(), Moments{}, merge);
            for (const Moments& merged : {chain, merge_in_pairs(pieces)}) {
                EXPECT_EQ(merged.count, whole.count);
                EXPECT_EQ(merged.weight, whole.weight);
                EXPECT_NEAR(merged.mean[0], whole.mean[0], 1e-14 * extent);
                EXPECT_NEAR(merged.deviation[0], whole.deviation[0], 1e-14 * whole.deviation[0]);
            }
        }
    }
}

}  // namespace
}  // namespace rrcb
