#include "clouds_of_all_ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/quality.hpp>

#include <bit>

namespace rrcb {
namespace {

using test::share_of_cloud;
using test::three_columns;

struct Cloud {
    std::string name;
    std::function<double(std::size_t i, int axis, double u)> coordinate;
};

const std::vector<Cloud>& clouds_without_coincident_points() {
    static const std::vector<Cloud> clouds{
        {"uniform", [](std::size_t, int, double u) { return u; }},
        {"lattice",
         [](std::size_t i, int axis, double) {
             return static_cast<double>(axis == 0   ? i % 16
                                        : axis == 1 ? i / 16 % 16
                                                    : i / 256) +
                    (axis == 1 ? 1e-3 * static_cast<double>(i / 256) : 0);
         }},
        {"power law", [](std::size_t, int, double u) { return std::pow(u, 9); }},
        {"far clusters",
         [](std::size_t i, int, double u) { return 1e6 * static_cast<double>(i % 2) + 1e-6 * u; }},
        {"collinear",
         [](std::size_t i, int axis, double) { return axis == 0 ? static_cast<double>(i) : 3.0; }},
        {"far offset", [](std::size_t, int, double u) { return 1e9 + u; }},
        {"subnormal", [](std::size_t i, int axis,
                         double) { return 5e-324 * static_cast<double>(axis == 0 ? i : i % 7); }},
        {"whole range", [](std::size_t, int, double u) { return (2 * u - 1) * 1.7e308; }}};
    return clouds;
}

void expect_look_ups_agree(const Points& points, const Balance& result) {
    for (LocalIndex i = 0; i < points.count; ++i)
        ASSERT_EQ(result.parts[i], part_of(result.cuts, points.position(i)));
}

TEST(Refinement, exact_leaves_each_part_within_one_object_of_the_ideal) {
    for (const Cloud& cloud : clouds_without_coincident_points()) {
        for (const int dimension : {1, 2, 3}) {
            if (dimension == 1 && cloud.name == "lattice") continue;  // coincident in 1-D
            for (const int num_parts : {2, 5, 8}) {
                const auto mine = share_of_cloud(4096, dimension, cloud.coordinate);
                const Points points(mine, dimension);
                Options options{.num_parts = num_parts, .refine = Refine::exact};
                const Balance result = balance(points, MPI_COMM_WORLD, options);
                const auto weights = part_weights(points, result.parts, num_parts, MPI_COMM_WORLD);
                for (const double weight : weights)
                    EXPECT_LE(std::abs(weight - 4096.0 / num_parts), 1)
                        << cloud.name << ", " << dimension << "-D, " << num_parts << " parts";
                EXPECT_EQ(result.report.imbalance, imbalance(weights));
                expect_look_ups_agree(points, result);
                const int levels = std::bit_width(static_cast<unsigned>(num_parts - 1));
                EXPECT_LE(result.report.details.rounds, 6 * levels) << cloud.name;
            }
        }
    }
}

TEST(Refinement, a_good_estimate_takes_one_look) {
    const auto mine = share_of_cloud(100000, 2, [](std::size_t, int, double u) { return u; });
    Options options{.num_parts = 4};
    const Balance result = balance(Points(mine, 2), MPI_COMM_WORLD, options);
    EXPECT_EQ(result.report.details.rounds, 1);
}

TEST(Refinement, exact_takes_two_rounds_a_level_on_a_smooth_cloud) {
    const auto mine = share_of_cloud(40000, 2, [](std::size_t, int, double u) { return u; });
    Options options{.num_parts = 8, .refine = Refine::exact};
    const Balance result = balance(Points(mine, 2), MPI_COMM_WORLD, options);
    EXPECT_LE(result.report.details.rounds, 2 * 3);
}

TEST(Refinement, takes_at_most_sixteen_rounds_a_level_over_hundreds_of_decades) {
    for (const double decades : {3.0, 30.0, 300.0}) {
        const auto mine = share_of_cloud(
            20000, 2, [&](std::size_t, int, double u) { return std::pow(10, -decades * u); });
        const Points points(mine, 2);
        for (const Refine refine : {Refine::tolerance, Refine::exact}) {
            Options options{.num_parts = 8, .refine = refine};
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            EXPECT_LE(result.report.imbalance, refine == Refine::exact ? 1.0004 : 1.01);
            EXPECT_LE(result.report.details.rounds, 1 + 16 * 3) << decades << " decades";
            expect_look_ups_agree(points, result);
        }
    }
}

TEST(Refinement, fewer_points_than_parts_leave_cuts_that_are_numbers) {
    const std::vector<double> mine =
        rank() == 0 ? std::vector<double>{0, 1, 2, 3} : std::vector<double>();
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
        for (const int num_parts : {3, 4, 9}) {
            Options options{.num_parts = num_parts, .refine = refine};
            const Points points(mine, 2);
            const Balance result = balance(points, MPI_COMM_WORLD, options);
            for (const Cut& cut : result.cuts.tree)
                for (const double value : cut.at) EXPECT_FALSE(std::isnan(value));
            const auto weights = part_weights(points, result.parts, num_parts, MPI_COMM_WORLD);
            EXPECT_EQ(*std::max_element(weights.begin(), weights.end()), 1);
        }
    }
}

TEST(EarlierCuts, of_the_same_points_are_found_good_at_one_look) {
    const auto mine = share_of_cloud(4000, 2, [](std::size_t, int, double u) { return u * u; });
    const Points points(mine, 2);
    Options options{.num_parts = 6};
    const Balance first = balance(points, MPI_COMM_WORLD, options);
    const Balance second = balance(points, MPI_COMM_WORLD, options, first.cuts);
    EXPECT_EQ(second.report.details.rounds, 1);
    EXPECT_EQ(second.report.details.num_cells, 0);
    EXPECT_EQ(second.parts, first.parts);
}

TEST(EarlierCuts, make_room_for_other_part_sizes) {
    const auto mine = share_of_cloud(4000, 2, [](std::size_t, int, double u) { return u; });
    const Points points(mine, 2);
    Options options{.num_parts = 4, .refine = Refine::exact};
    const Balance first = balance(points, MPI_COMM_WORLD, options);
    options.part_sizes = {0, 2, 1, 1};
    const Balance second = balance(points, MPI_COMM_WORLD, options, first.cuts);
    const auto weights = part_weights(points, second.parts, 4, MPI_COMM_WORLD);
    EXPECT_EQ(weights[0], 0);
    EXPECT_NEAR(weights[1], 2000, 1);
}

TEST(EarlierCuts, that_were_tilted_are_made_planes_where_planes_are_asked_for) {
    const std::vector<double> mine = three_columns();
    const Points points(mine, 2);
    Options options{.num_parts = 2,
                    .refine = Refine::exact,
                    .expert = {.axes = {.order = AxisOrder::longest()}}};
    const Balance tilted = balance(points, MPI_COMM_WORLD, options);
    ASSERT_GT(tilted.cuts.tree[0].at[1], -std::numeric_limits<double>::infinity());
    options.expert.axes.plain = true;
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact}) {
        options.refine = refine;
        const Balance plain = balance(points, MPI_COMM_WORLD, options, tilted.cuts);
        EXPECT_EQ(plain.cuts.tree[0].at[1], -std::numeric_limits<double>::infinity());
        expect_look_ups_agree(points, plain);
    }
}

}  // namespace
}  // namespace rrcb
