// The check of ghosts that users can call, of sound plans and of damaged ones.
#include "../support/clouds.hpp"
#include "../support/ranks.hpp"
#include "../support/same_error.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/experimental/verify.hpp>
#include <rrcb/ghosts.hpp>

namespace rrcb {
namespace {

constexpr std::size_t everything = std::numeric_limits<std::size_t>::max();
constexpr Box unit{{0, 0, 0}, {1, 1, 1}};

/// Points of this rank after a balance, with ids; those with an id divisible by 7 need more.
struct Scene {
    explicit Scene(int dimension_of_points) : dimension(dimension_of_points) {
        const auto d = static_cast<std::size_t>(dimension);
        const std::vector<double> scattered =
            test::uniform_cloud(60, dimension, static_cast<unsigned>(rank() + 1));
        for (std::size_t i = 0; i < 60; ++i)
            before.push_back(1000 * static_cast<std::uint64_t>(rank()) + i);
        const Balance made = balance(Points(scattered, dimension), MPI_COMM_WORLD);
        cuts = made.cuts;
        std::tie(ids, x) = transfer(plan(made, MPI_COMM_WORLD),
                                    columns(before, column(scattered, d)), MPI_COMM_WORLD);
        for (const std::uint64_t id : ids) radii.push_back(id % 7 == 0 ? 0.3 : 0.1);
    }

    Points points() const { return Points(x, dimension); }
    GhostPlan near(const GhostOptions& options) const {
        return ghost_plan(cuts, points(), MPI_COMM_WORLD, options);
    }
    experimental::Verification seen(const GhostPlan& plan,
                                    experimental::VerifyOptions options = {everything}) const {
        options.ids = ids;
        return experimental::verify(plan, points(), MPI_COMM_WORLD, options);
    }

    int dimension;
    Cuts cuts{};
    std::vector<std::uint64_t> before{};
    std::vector<std::uint64_t> ids{};
    std::vector<double> x{};
    std::vector<double> radii{};
};

void expect_sound(const experimental::Verification& seen) {
    EXPECT_EQ(seen.num_faults, 0);
    EXPECT_TRUE(seen.missing.empty() && seen.duplicates.empty() && seen.not_mine.empty());
}

/// Returns the number of pairs of points of two ranks, or images, by brute force.
GlobalCount num_pairs(const Scene& scene, double radius, int most_periods) {
    const auto d = static_cast<std::size_t>(scene.dimension);
    const std::vector<Part> parts(scene.ids.size(), 0);
    const auto gathered = transfer(
        plan(parts, num_ranks(), MPI_COMM_WORLD),
        columns(column(scene.x, d), std::vector<int>(scene.ids.size(), rank())), MPI_COMM_WORLD);
    std::int64_t count = 0;
    const auto& [x, owners] = gathered;
    for (std::size_t i = 0; i < owners.size(); ++i)
        for (std::size_t j = 0; j < owners.size(); ++j)
            for (int k = -most_periods; k <= most_periods; ++k)
                for (int l = -most_periods; l <= most_periods; ++l) {
                    if (owners[i] == owners[j] && k == 0 && l == 0) continue;
                    const double apart =
                        std::hypot(x[2 * j] + k - x[2 * i], x[2 * j + 1] + l - x[2 * i + 1]);
                    count += apart <= radius ? 1 : 0;
                }
    MPI_Bcast(&count, 1, MPI_INT64_T, 0, MPI_COMM_WORLD);
    return count;
}

TEST(Verify, finds_all_pairs_and_no_faults_in_sound_plans) {
    const Scene scene(2);
    for (const double radius : {0.0, 0.1, 0.7}) {
        for (const bool is_periodic : {false, true}) {
            GhostOptions options{.cutoff = radius};
            if (is_periodic) options.periodic = unit;
            const experimental::Verification seen = scene.seen(scene.near(options));
            expect_sound(seen);
            EXPECT_EQ(seen.num_pairs, num_pairs(scene, radius, is_periodic ? 1 : 0));
        }
    }
}

TEST(Verify, looks_at_no_more_than_a_sample) {
    const Scene scene(2);
    const GhostPlan near = scene.near({.cutoff = 0.5, .periodic = unit});
    const GlobalCount all = scene.seen(near).num_pairs;
    const GlobalCount some =
        scene.seen(near, {10 * static_cast<std::size_t>(num_ranks())}).num_pairs;
    EXPECT_NEAR(6.0 * static_cast<double>(some), static_cast<double>(all),
                0.2 * static_cast<double>(all));
    EXPECT_EQ(scene.seen(near, {0}).num_pairs, 0);
}

TEST(Verify, names_the_pairs_whose_ghosts_are_missing) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const Scene scene(2);
    const experimental::Verification less =
        scene.seen(scene.near({.cutoff = 0.05}), {.sample = everything, .cutoff = 0.1});
    EXPECT_GT(less.num_faults, 0);
    const std::vector<std::uint64_t> wide =
        fetch(scene.near({.cutoff = 0.1}), scene.ids, MPI_COMM_WORLD);
    for (const experimental::Fault& fault : less.missing) {
        EXPECT_EQ(std::ranges::count(wide, fault.id), 1);
        EXPECT_EQ(std::ranges::count(scene.ids, fault.needed_by), 1);
        EXPECT_NE(fault.rank, rank());
    }
    EXPECT_TRUE(less.duplicates.empty() && less.not_mine.empty());
    // With more than the ghosts' radius where points have moved apart, all is well.
    expect_sound(scene.seen(scene.near({.cutoff = 0.1}), {.sample = everything, .cutoff = 0.05}));
}

TEST(Verify, names_ghosts_that_came_twice_and_own_points) {
    const Scene scene(2);
    GhostPlan plan;
    plan.num_points = scene.ids.size();
    plan.cutoff = 0;
    const int next = (rank() + 1) % num_ranks();
    plan.send = {{next, 3}};
    plan.send_indices = {5, 7, 7};
    plan.receive = {{(rank() + num_ranks() - 1) % num_ranks(), 3}};
    const experimental::Verification seen = scene.seen(plan);
    EXPECT_EQ(seen.duplicates.size(), 1u);
    EXPECT_EQ(seen.duplicates.at(0).rank, plan.receive[0].rank);
    EXPECT_EQ(seen.not_mine.size(), num_ranks() == 1 ? 3u : 0u);
    EXPECT_EQ(seen.num_faults, num_ranks() == 1 ? 4 : num_ranks());
}

TEST(Verify, names_ids_that_are_lost_or_new_or_on_two_ranks) {
    Scene scene(2);
    const GhostPlan near = scene.near({.cutoff = 0.1});
    experimental::VerifyOptions options{.sample = 0, .ids_before = scene.before};
    expect_sound(scene.seen(near, options));
    const std::uint64_t lost = scene.ids[3];
    const auto own = static_cast<std::uint64_t>(rank());
    scene.ids[3] = 500 + 1000 * own;
    const experimental::Verification seen = scene.seen(near, options);
    EXPECT_EQ(seen.num_faults, 2 * num_ranks());
    ASSERT_EQ(seen.not_mine.size(), 1u);
    EXPECT_EQ(seen.not_mine[0].id, scene.ids[3]);
    EXPECT_EQ(seen.not_mine[0].rank, rank());
    for (const experimental::Fault& fault : seen.missing) {
        EXPECT_EQ(std::ranges::count(scene.before, fault.id), 1);
        EXPECT_EQ(fault.rank, rank());
    }
    scene.ids[3] = lost;
    if (is_last_rank() && rank() > 0) scene.ids[4] = 999999;
    if (rank() == 0) scene.ids[4] = 999999;
    const experimental::Verification twice = scene.seen(near, {.sample = 0});
    EXPECT_EQ(twice.num_faults, num_ranks() > 1 ? 2 : 0);
    const bool has_it = num_ranks() > 1 && (rank() == 0 || is_last_rank());
    ASSERT_EQ(twice.duplicates.size(), has_it ? 1u : 0u);
    if (has_it) {
        EXPECT_EQ(twice.duplicates[0].rank, rank() == 0 ? num_ranks() - 1 : 0);
    }
}

TEST(Verify, refuses_what_does_not_fit_on_one_rank_on_all) {
    const Scene scene(2);
    const GhostPlan near = scene.near({.cutoff = scene.radii, .needs = Needs::gather});
    const auto refused = [&](const std::string& text, const experimental::VerifyOptions& options,
                             const Points& points) {
        test::expect_same_error(
            [&] { experimental::verify(near, points, MPI_COMM_WORLD, options); }, text);
    };
    const std::vector<double> few(2);
    const std::vector<std::uint64_t> ids(1);
    const bool is_last = is_last_rank();
    refused("give one for all points", {}, scene.points());
    experimental::VerifyOptions options{.cutoff = 0.1};
    refused("points must be as many as the plan", options,
            is_last ? Points(few, 2) : scene.points());
    options.ids_before = ids;
    refused("ids_before needs ids", options, scene.points());
    options.ids = is_last ? ids : std::span<const std::uint64_t>(scene.ids);
    refused("ids must have one entry for each point", options, scene.points());
    if (num_ranks() == 1) return;
    refused("the sample differs", {.sample = is_last ? 1u : 2u, .cutoff = 0.1}, scene.points());
}

}  // namespace
}  // namespace rrcb
