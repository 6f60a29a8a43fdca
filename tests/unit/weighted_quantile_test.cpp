#include "bisection/weighted_quantile.hpp"

#include "../support/clouds.hpp"
#include "../support/common.hpp"
#include "bisection/profile.hpp"

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

StatisticalDomain domain_of(const std::vector<Patch>& patches, int dimension = 1) {
    return {dimension, patches};
}

double quantile(const std::vector<Patch>& patches, double target) {
    const StatisticalDomain domain = domain_of(patches);
    return weighted_quantile(Profile(domain), 0, target, false).at[0];
}

TEST(WeightedQuantile, divides_a_patch_in_the_ratio_of_the_weights) {
    EXPECT_EQ(quantile({{{0}, {4}, 8}}, 2), 1);
    EXPECT_EQ(quantile({{{0}, {4}, 8}, {{4}, {5}, 4}}, 10), 4.5);
    EXPECT_EQ(quantile({{{0}, {4}, 4}, {{2}, {6}, 4}}, 4), 3);  // where they overlap
}

TEST(WeightedQuantile, lies_in_the_middle_of_a_gap_with_the_target_below_it) {
    EXPECT_EQ(quantile({{{0}, {1}, 1}, {{3}, {4}, 1}}, 1), 2);
    EXPECT_EQ(quantile({{{0}, {1}, 0.1}, {{0}, {1}, 0.2}, {{3}, {4}, 1}}, 0.3), 2);
}

TEST(WeightedQuantile, leaves_a_jump_on_the_nearer_side) {
    const std::vector<Patch> patches{{{0}, {1}, 1}, {{2}, {2}, 4}, {{3}, {4}, 1}};
    EXPECT_EQ(quantile(patches, 2), 2);    // 1 of 4: above
    EXPECT_EQ(quantile(patches, 4), 2.5);  // 3 of 4: below, in the gap behind it
}

TEST(WeightedQuantile, divides_a_jump_along_the_other_axes_unless_it_is_to_be_plain) {
    const StatisticalDomain domain = domain_of({{{2, 0}, {2, 4}, 8}}, 2);
    const Cut cut = weighted_quantile(Profile(domain), 0, 2, false);
    EXPECT_EQ(cut.at[0], 2);
    EXPECT_EQ(cut.at[1], 1);
    const Cut plain = weighted_quantile(Profile(domain), 0, 2, true);
    EXPECT_EQ(plain.at[1], -infinity);
}

TEST(WeightedQuantile, passes_over_patches_without_weight) {
    EXPECT_EQ(quantile({{{-9}, {-8}, 0}, {{0}, {4}, 8}, {{9}, {9}, 0}}, 2), 1);
}

/// Share of a patch below a cut, by its corners and volume: worked out with no word of breakpoints.
double share_below(const Patch& patch, const Cut& cut, int dimension) {
    std::vector<std::size_t> axes{static_cast<std::size_t>(cut.axis)};
    for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
        if (a != axes[0]) axes.push_back(a);
    for (const std::size_t a : axes) {
        if (cut.at[a] <= patch.lower[a] && patch.lower[a] < patch.upper[a]) return 0;
        if (cut.at[a] < patch.lower[a]) return 0;
        if (cut.at[a] > patch.upper[a]) return 1;
        if (patch.lower[a] < patch.upper[a])
            return (cut.at[a] - patch.lower[a]) / (patch.upper[a] - patch.lower[a]);
    }
    return 0;  // exactly at the cut: above
}

std::vector<Patch> random_patches(std::mt19937_64& engine, int dimension) {
    std::vector<Patch> patches(1 + engine() % 12);
    for (Patch& patch : patches) {
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
            // On a coarse lattice, half of them flat, so that they overlap, touch and coincide.
            patch.lower[a] = static_cast<double>(engine() % 6);
            patch.upper[a] = patch.lower[a] + static_cast<double>((engine() % 2) * (engine() % 4));
        }
        patch.weight = static_cast<double>(engine() % 4);
    }
    patches[0].weight = 1;
    return patches;
}

TEST(WeightedQuantile, has_the_target_below_it_but_for_patches_in_one_place) {
    std::mt19937_64 engine(8);
    int num_exact = 0;
    for (int round = 0; round < 3000; ++round) {
        const int dimension = 1 + round % 3;
        const std::vector<Patch> patches = random_patches(engine, dimension);
        double total = 0;
        for (const Patch& patch : patches) total += patch.weight;
        const double target = total * test::uniform(engine);
        const int axis = static_cast<int>(engine() % static_cast<unsigned>(dimension));
        const StatisticalDomain domain = domain_of(patches, dimension);
        const Cut cut = weighted_quantile(Profile(domain), axis, target, false);
        double below = 0;
        for (const Patch& patch : patches)
            below += patch.weight * share_below(patch, cut, dimension);
        // The heaviest place decides how far the weight may be off: by half of it.
        double heaviest = 0;
        for (const Patch& patch : patches) {
            if (patch.lower != patch.upper) continue;
            double weight = 0;
            for (const Patch& other : patches)
                if (other.lower == patch.lower && other.upper == patch.upper)
                    weight += other.weight;
            heaviest = std::max(heaviest, weight);
        }
        EXPECT_NEAR(below, target, heaviest / 2 + 1e-9) << "round " << round;
        num_exact += std::abs(below - target) < 1e-9;
    }
    EXPECT_GT(num_exact, 1000) << "most clouds have patches in one place";
}

/// Share of a patch below a value along axis 0, by the antiderivative of its density.
double share_below(const Patch& patch, double value) {
    if (value <= patch.lower[0]) return 0;
    if (value >= patch.upper[0]) return 1;
    const double u = 2 * (value - patch.lower[0]) / (patch.upper[0] - patch.lower[0]) - 1;
    return (1 + u) / 2 + patch.slope[0] * (u * u - 1) / 4 + patch.bow[0] * (u * u * u - u) / 4;
}

/// Patches of many sizes about a few places, many more than a search looks at in turn.
std::vector<Patch> many_patches(std::mt19937_64& engine) {
    std::vector<Patch> patches;
    for (int i = 0; i < 2000; ++i) {
        const double place = std::pow(10.0, static_cast<double>(engine() % 6));
        const double lower = place * (1 + test::uniform(engine));
        const double extent = place * std::pow(test::uniform(engine, 0.05), 4);
        const double slope = 2 * test::uniform(engine) - 1;
        const double bow = (1 - std::abs(slope)) * (2 * test::uniform(engine) - 1);
        patches.push_back({{lower}, {lower + extent}, test::uniform(engine), {slope}, {bow}});
    }
    return patches;
}

TEST(WeightedQuantile, has_the_target_below_it_among_many_patches) {
    std::mt19937_64 engine(9);
    for (int round = 0; round < 50; ++round) {
        const StatisticalDomain domain = domain_of(many_patches(engine));
        double total = 0;
        for (const Patch& patch : domain.patches) total += patch.weight;
        const Profile profile(domain);
        for (int k = 0; k <= 20; ++k) {
            const double target = total * k / 20.5;
            const double value = weighted_quantile(profile, 0, target, false).at[0];
            double below = 0;
            for (const Patch& patch : domain.patches)
                below += patch.weight * share_below(patch, value);
            EXPECT_NEAR(below, target, 1e-9 * total);
        }
    }
}

TEST(Profile, reads_the_weight_near_a_cut) {
    std::vector<Patch> patches;
    for (int i = 0; i < 303; ++i) patches.push_back({{0.01 * i}, {0.01 * i + 0.01}, 1});
    const StatisticalDomain domain = domain_of(patches);
    const Profile profile(domain);
    EXPECT_NEAR(profile.weight_near(0, 1, 0.2), 40, 1e-9);
    EXPECT_NEAR(profile.weight_near(0, 0.05, 0.2), 25, 1e-9) << "nothing is below 0";
    EXPECT_NEAR(profile.weight_near(0, 1, 0), 200, 1e-9) << "as in an even box";
    EXPECT_EQ(profile.weight_near(0, infinity, 0.2), 303) << "all is on one side";
}

TEST(Profile, has_the_weight_below_a_value_of_the_slices) {
    std::mt19937_64 engine(10);
    const StatisticalDomain domain = domain_of(many_patches(engine));
    const Profile profile(domain);
    for (const double value : {1.1, 1.9, 10.5, 150.0, 1e5, 2e5}) {
        double below = 0;
        for (const Patch& patch : domain.patches) below += patch.weight * share_below(patch, value);
        const double reach = value + 1;  // nothing is below 0
        EXPECT_NEAR(profile.weight_within(0, value - reach, reach), below,
                    1e-12 * profile.weight());
    }
}

TEST(Profile, finds_a_value_only_where_the_weight_grows) {
    const std::vector<Patch> patches{{{0}, {1}, 3}, {{2}, {2}, 4}, {{4}, {5}, 3}};
    const StatisticalDomain domain = domain_of(patches);
    const Profile profile(domain);
    const Profile::Range inside = profile.range_of(0, 1.5, 1e-9);
    EXPECT_NEAR(inside.value, 0.5, 1e-9);
    EXPECT_TRUE(profile.grows_at(0, inside, 1.5, 1e-9));
    const Profile::Range end = profile.range_of(0, 3, 1e-9);
    EXPECT_FALSE(std::isfinite(end.value) && profile.grows_at(0, end, 3, 1e-9)) << "a gap begins";
    const Profile::Range jump = profile.range_of(0, 5, 1e-9);
    EXPECT_TRUE(std::isnan(jump.value));
    EXPECT_LE(jump.lower, 2);
    EXPECT_GE(jump.upper, 2);
}

TEST(WeightedQuantile, that_is_plain_leaves_a_plane_of_patches_on_one_side) {
    const StatisticalDomain domain =
        domain_of({{{1, 0}, {1, 4}, 3}, {{1, 4}, {1, 8}, 3}, {{2, 0}, {3, 8}, 6}}, 2);
    EXPECT_EQ(weighted_quantile(Profile(domain), 0, 2, true).at[0], 1) << "0 is nearer than 6";
    EXPECT_EQ(weighted_quantile(Profile(domain), 0, 5, true).at[0], 1.5)
        << "in the gap behind the plane";
}

TEST(WeightedQuantile, keeps_a_jump_below_that_was_passed_by_nothing) {
    const double value = quantile({{{1}, {1}, 1}, {{1}, {2}, 1}}, 1);
    EXPECT_GT(value, 1);
    EXPECT_LT(value, 1 + 1e-11);
}

TEST(WeightedQuantile, of_nothing_is_below_all) {
    EXPECT_LE(quantile({{{1}, {4}, 8}}, 0), 1);
}

TEST(WeightedQuantile, does_not_overflow) {
    constexpr double largest = std::numeric_limits<double>::max();
    EXPECT_EQ(quantile({{{-largest}, {largest}, 8}}, 4), 0);
    EXPECT_EQ(quantile({{{-largest}, {-largest}, 1}, {{largest}, {largest}, 1}}, 1), 0);
}

}  // namespace
}  // namespace rrcb
