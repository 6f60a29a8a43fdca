#include "../support/common.hpp"

#include <rrcb/detail/bisection.hpp>
#include <rrcb/error.hpp>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

StatisticalDomain patches_1d(std::vector<std::array<double, 3>> lower_upper_weight) {
    StatisticalDomain domain{1, {}};
    for (const auto& [lower, upper, weight] : lower_upper_weight)
        domain.patches.push_back({{lower, 0, 0}, {upper, 0, 0}, weight});
    return domain;
}

double cut_in_two(StatisticalDomain domain, std::vector<double> sizes = {1, 1}) {
    return bisect(std::move(domain), 2, sizes).cuts.tree[0].at[0];
}

TEST(Bisection, cuts_one_uniform_patch_at_the_fraction) {
    EXPECT_DOUBLE_EQ(cut_in_two(patches_1d({{2, 6, 7}})), 4);
    EXPECT_DOUBLE_EQ(cut_in_two(patches_1d({{2, 6, 7}}), {1, 3}), 3);
}

TEST(Bisection, follows_the_piecewise_linear_weight_of_overlapping_patches) {
    // Densities 1 on [0, 2], 1 + 3 on [2, 4], 3 on [4, 6]: 16 in all, 8 below 3.5.
    EXPECT_DOUBLE_EQ(cut_in_two(patches_1d({{0, 4, 4}, {2, 6, 12}})), 3.5);
    // A quarter, 4 of 16, is reached at 2.5.
    EXPECT_DOUBLE_EQ(cut_in_two(patches_1d({{0, 4, 4}, {2, 6, 12}}), {1, 3}), 2.5);
}

TEST(Bisection, cuts_in_the_middle_of_a_gap) {
    EXPECT_DOUBLE_EQ(cut_in_two(patches_1d({{0, 1, 5}, {3, 4, 5}})), 2);
    EXPECT_DOUBLE_EQ(cut_in_two(patches_1d({{0, 0, 1}, {10, 10, 1}})), 5);
}

TEST(Bisection, mixes_patches_with_and_without_extent) {
    // 1 on [0, 1], a jump of 4 at 2, 1 on [3, 4]: the half lies inside the jump, and an
    // indivisible jump of which half is to be below goes below as a whole.
    EXPECT_DOUBLE_EQ(cut_in_two(patches_1d({{0, 1, 1}, {2, 2, 4}, {3, 4, 1}})), 2.5);
    // A third of the jump: it stays above.
    EXPECT_DOUBLE_EQ(cut_in_two(patches_1d({{0, 1, 1}, {2, 2, 3}, {3, 4, 2}}), {1, 2}), 2);
}

TEST(Bisection, crosses_the_longest_extent_first) {
    StatisticalDomain domain{3, {{{0, 0, 0}, {1, 5, 2}, 1}}};
    const Cuts cuts = bisect(domain, 2, {}).cuts;
    EXPECT_EQ(cuts.tree[0].axis, 1);
    EXPECT_DOUBLE_EQ(cuts.tree[0].at[1], 2.5);
    EXPECT_EQ(cuts.tree[0].at[0], -infinity);
}

TEST(Bisection, six_parts_of_a_square_hold_a_sixth_each) {
    StatisticalDomain domain{2, {{{0, 0, 0}, {6, 6, 0}, 36}}};
    const Bisection result = bisect(domain, 6, {});
    ASSERT_EQ(result.part_weights.size(), 6u);
    for (const double weight : result.part_weights) EXPECT_NEAR(weight, 6, 1e-12);
}

TEST(Bisection, honours_relative_part_sizes_with_zeros) {
    StatisticalDomain domain{2, {{{0, 0, 0}, {4, 1, 0}, 8}}};
    const std::vector<double> sizes{1, 0, 0, 2, 5};
    const Bisection result = bisect(domain, 5, sizes);
    for (std::size_t p = 0; p < 5; ++p) EXPECT_NEAR(result.part_weights[p], sizes[p], 1e-12);
}

TEST(Bisection, of_nothing_leaves_all_parts_empty) {
    const Bisection result = bisect({2, {}}, 3, {});
    EXPECT_EQ(result.cuts.tree.size(), 2u);
    EXPECT_EQ(result.part_weights, (std::vector<double>{0, 0, 0}));
}

TEST(Bisection, survives_the_whole_range_of_double) {
    constexpr double huge = std::numeric_limits<double>::max();
    EXPECT_EQ(cut_in_two(patches_1d({{-huge, huge, 1}})), 0);
    EXPECT_EQ(cut_in_two(patches_1d({{-huge, -huge, 1}, {huge, huge, 1}})), 0);
    EXPECT_EQ(cut_in_two(patches_1d({{0, 0, 1}, {1e-323, 1e-323, 1}})), 5e-324);
}

TEST(Bisection, of_arguments_out_of_range_is_refused) {
    StatisticalDomain domain{2, {{{0, 0, 0}, {1, 1, 0}, 1}}};
    const auto expect_refusal = [&](int num_parts, const std::vector<double>& sizes) {
        EXPECT_THROW(bisect(domain, num_parts, sizes), Error);
    };
    expect_refusal(0, {});
    expect_refusal(-1, {});
    expect_refusal(3, {1, 2});
    expect_refusal(3, {1, 2, 3, 4});
    expect_refusal(3, {1, 2, -3});
    expect_refusal(3, {0, 0, 0});
    expect_refusal(2, {1, std::numeric_limits<double>::quiet_NaN()});
    domain.dimension = 9;
    expect_refusal(3, {});
    const std::vector<double> x(12, 0.5);
    EXPECT_THROW(make_support_mesh({}, 2, 0), Error);
    EXPECT_THROW(make_support_mesh({}, 4, 1), Error);
    const SupportMesh mesh = make_support_mesh({{0, 0, 0}, {1, 1, 1}}, 2, 4);
    EXPECT_THROW(cell_moments(Points(x, 3), mesh), Error);
    EXPECT_THROW(analytic_domain({}, 9, {}), Error);
}

}  // namespace
}  // namespace rrcb
