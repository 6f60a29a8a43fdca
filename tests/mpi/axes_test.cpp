#include "clouds_of_all_ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/quality.hpp>

namespace rrcb {
namespace {

using test::share_of_cloud;
using test::three_columns;

TEST(GivenAxes, are_crossed_in_groups) {
    // 8 parts of a box of 1 x 5: three cuts of the longest extent, all across y.
    const auto mine = share_of_cloud(
        8000, 2, [](std::size_t, int axis, double u) { return axis == 0 ? u : 5 * u; });
    const Points points(mine, 2);
    Options options{.num_parts = 8, .expert = {.axes = {.order = AxisOrder::grouped({0, 1})}}};
    const Balance tall = balance(points, MPI_COMM_WORLD, options);
    for (const Cut& cut : tall.cuts.tree) EXPECT_EQ(cut.axis, 1);

    // A square: two levels across one axis, one across the other, in the order asked for.
    const auto square = share_of_cloud(8000, 2, [](std::size_t, int, double u) { return u; });
    for (const int first : {0, 1}) {
        options.expert.axes.order = AxisOrder::grouped({first, 1 - first});
        const Balance even = balance(Points(square, 2), MPI_COMM_WORLD, options);
        EXPECT_EQ(even.cuts.tree[0].axis, first);
        for (const std::size_t leaf_cut : {2u, 3u, 5u, 6u})
            EXPECT_EQ(even.cuts.tree[leaf_cut].axis, 1 - first);
    }
}

TEST(GivenAxes, of_each_cut_are_kept) {
    const auto mine = share_of_cloud(4000, 3, [](std::size_t, int, double u) { return u; });
    Options options{.num_parts = 4, .expert = {.axes = {.order = AxisOrder::given({2, 0, 1})}}};
    const std::vector<int> axes{2, 0, 1};
    const Balance result = balance(Points(mine, 3), MPI_COMM_WORLD, options);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(result.cuts.tree[k].axis, axes[k]);
    EXPECT_LE(result.report.imbalance, 1.01);
}

TEST(GivenAxes, of_each_cut_are_kept_also_by_many_ranks_and_where_nothing_is_to_be_cut) {
    const auto mine = share_of_cloud(3, 2, [](std::size_t, int, double u) { return u; });
    Options options{.num_parts = 2 * num_ranks(), .expert = {.max_root_parts = 2}};
    options.part_sizes.assign(static_cast<std::size_t>(options.num_parts), 1);
    options.part_sizes.front() = 0;
    options.expert.axes.order =
        AxisOrder::given(std::vector<int>(static_cast<std::size_t>(options.num_parts) - 1, 1));
    const Balance result = balance(Points(mine, 2), MPI_COMM_WORLD, options);
    for (const Cut& cut : result.cuts.tree) EXPECT_EQ(cut.axis, 1);
}

TEST(AllowedAxes, are_crossed_by_all_cuts) {
    // The longest axis is none of them.
    const auto mine = share_of_cloud(
        8000, 3, [](std::size_t, int axis, double u) { return axis == 0 ? 5 * u : u; });
    const Points points(mine, 3);
    Options options{.num_parts = 2 * num_ranks() + 1,
                    .expert = {.axes = {.order = AxisOrder::among({2})}}};
    for (const Refine refine : {Refine::none, Refine::tolerance, Refine::exact})
        for (const int central : {2, 4096}) {
            options.refine = refine;
            options.expert.max_root_parts = central;
            const Balance layers = balance(points, MPI_COMM_WORLD, options);
            for (const Cut& cut : layers.cuts.tree) EXPECT_EQ(cut.axis, 2);
        }
    options.expert.max_root_parts = 4096;
    options.refine = Refine::tolerance;
    options.expert.axes.min_width = {1e-3, 1e-3, 1e-3};
    for (const Cut& cut : balance(points, MPI_COMM_WORLD, options).cuts.tree)
        EXPECT_EQ(cut.axis, 2);
    options.expert.axes.min_width = {1e-3, 1e-3, 0.9 / options.num_parts};
    EXPECT_NO_THROW(balance(points, MPI_COMM_WORLD, options));
    options.expert.axes.min_width = {1e-3, 1e-3, 0.6};
    EXPECT_THROW(balance(points, MPI_COMM_WORLD, options), Error);
}

TEST(PlainCuts, keep_points_on_a_plane_together) {
    const std::vector<double> mine = three_columns();
    const Points points(mine, 2);
    Options options{.num_parts = 2, .refine = Refine::exact, .expert = {.axes = {.plain = true}}};
    const Balance plain = balance(points, MPI_COMM_WORLD, options);
    EXPECT_EQ(part_weights(points, plain.parts, 2, MPI_COMM_WORLD),
              (std::vector<double>{400, 200}));
    EXPECT_EQ(plain.cuts.tree[0].at[1], -std::numeric_limits<double>::infinity());
    EXPECT_EQ(plain.report.details.coincident_cuts, 1);
    options.expert.axes.plain = false;
    const Balance tilted = balance(points, MPI_COMM_WORLD, options);
    EXPECT_EQ(part_weights(points, tilted.parts, 2, MPI_COMM_WORLD),
              (std::vector<double>{300, 300}));
    EXPECT_EQ(tilted.report.details.coincident_cuts, 0);
}

}  // namespace
}  // namespace rrcb
