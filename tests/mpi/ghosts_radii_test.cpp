#include "../support/distance.hpp"
#include "../support/same_error.hpp"
#include "held_points.hpp"
#include "slabs.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>

namespace rrcb {
namespace {

using test::distance;

constexpr std::size_t num_points = 400;

/// A cloud and radii that every rank knows, and the points of this rank by number.
struct Scene {
    int dimension;
    std::vector<double> positions = test::uniform_cloud(num_points, dimension, 7);
    std::vector<double> radii{};
    Cuts cuts{};
    std::vector<int> mine{};
    std::vector<double> here{};
    std::vector<double> radii_here{};

    Vector position(int i) const {
        return Points(positions, dimension).position(static_cast<LocalIndex>(i));
    }
};

Scene make_scene(int dimension) {
    Scene scene{dimension};
    for (std::size_t i = 0; i < num_points; ++i)
        scene.radii.push_back(std::vector{0.0, 0.01, 0.1, 0.5, 2.0}[i % 5]);
    test::HeldPoints all{dimension, scene.positions, scene.radii};
    scene.cuts = test::divide_on_each_rank(all, num_ranks()).cuts;
    const test::Share mine(all);
    scene.mine.assign(mine.indices.begin(), mine.indices.end());
    scene.here = mine.coordinates;
    scene.radii_here = mine.weights;
    return scene;
}

/// Returns for each point of this rank the number of others nearer than the greater of two radii.
std::vector<int> neighbours_by_brute_force(const Scene& scene, int most_periods) {
    std::vector<int> counts;
    for (const int i : scene.mine) {
        counts.push_back(0);
        const Vector x = scene.position(i);
        for (int j = 0; j < static_cast<int>(num_points); ++j)
            for (int k = -most_periods; j != i && k <= most_periods; ++k)
                for (int l = -most_periods; l <= most_periods; ++l) {
                    Vector image = scene.position(j);
                    image[0] += k;
                    image[1] += l;
                    const double radius = std::max(scene.radii[static_cast<std::size_t>(i)],
                                                   scene.radii[static_cast<std::size_t>(j)]);
                    counts.back() += distance(image, Box{x, x}, 2) < radius;
                }
    }
    return counts;
}

template <class T>
std::vector<T> with_ghosts(const GhostPlan& plan, std::vector<T> own) {
    const std::vector<T> ghosts = fetch(plan, own, MPI_COMM_WORLD);
    own.insert(own.end(), ghosts.begin(), ghosts.end());
    return own;
}

std::vector<int> neighbours_by_pairs(const Scene& scene, const GhostPlan& plan) {
    std::vector<double> x = scene.here;
    std::vector<double> images = fetch(plan, column(scene.here, 2), MPI_COMM_WORLD);
    apply_shifts(plan, images);
    x.insert(x.end(), images.begin(), images.end());
    const std::vector<int> numbers = with_ghosts(plan, scene.mine);
    const std::vector<double> radii = with_ghosts(plan, scene.radii_here);
    std::vector<int> counts(numbers.size());
    for (std::size_t i = 0; i < scene.mine.size(); ++i)
        for (std::size_t j = i + 1; j < numbers.size(); ++j) {
            const bool is_ours = std::pair(radii[i], numbers[i]) < std::pair(radii[j], numbers[j]);
            if (j >= scene.mine.size() && !is_ours) continue;
            const double apart = std::hypot(x[2 * i] - x[2 * j], x[2 * i + 1] - x[2 * j + 1]);
            if (apart >= std::max(radii[i], radii[j])) continue;
            ++counts[i];
            ++counts[j];
        }
    const std::span all(counts);
    return accumulate(plan, all.subspan(scene.mine.size()), all.first(scene.mine.size()),
                      MPI_COMM_WORLD);
}

TEST(GhostsOfRadii, meet_every_pair_once_on_the_rank_of_the_smaller_radius) {
    const Scene scene = make_scene(2);
    const Points points(scene.here, 2);
    GhostOptions options{.cutoff = scene.radii_here};
    EXPECT_EQ(neighbours_by_pairs(scene, ghost_plan(scene.cuts, points, MPI_COMM_WORLD, options)),
              neighbours_by_brute_force(scene, 0));
    options.periodic = Box{{0, 0}, {1, 1}};
    EXPECT_EQ(neighbours_by_pairs(scene, ghost_plan(scene.cuts, points, MPI_COMM_WORLD, options)),
              neighbours_by_brute_force(scene, 3));
}

TEST(GhostsOfRadii, are_those_of_one_radius_if_all_are_equal) {
    const Scene scene = make_scene(2);
    const Points points(scene.here, 2);
    const std::vector<double> equal(scene.mine.size(), 0.1);
    EXPECT_EQ(ghost_plan(scene.cuts, points, MPI_COMM_WORLD, {.cutoff = equal}).send_indices,
              ghost_plan(scene.cuts, points, MPI_COMM_WORLD, {.cutoff = 0.1}).send_indices);
}

TEST(GhostsOfRadii, that_do_not_fit_on_one_rank_are_refused_on_all) {
    const std::vector<double> x(4);
    const auto refused = [&](const std::string& text, const std::vector<double>& wrong) {
        const std::vector<double> radii = is_last_rank() ? wrong : std::vector{1.0, 0.0};
        test::expect_same_error(
            [&] { ghost_plan(test::slabs(), Points(x, 2), MPI_COMM_WORLD, {.cutoff = radii}); },
            "rank " + std::to_string(num_ranks() - 1) + ": " + text);
    };
    refused("cutoffs must have one entry for each point", {1.0});
    refused("cutoffs must have one entry for each point", {});
    for (const double radius : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        refused("each cutoff must be finite, 0 or more", {1.0, radius});
}

TEST(GhostsOfRadii, on_some_ranks_alone_are_refused_unless_the_others_have_no_points) {
    if (num_ranks() == 1) GTEST_SKIP() << "needs two ranks";
    const std::vector<double> x(2);
    const std::vector<double> radii(1);
    const auto find = [&](const Points& of_last) {
        return is_last_rank()
                   ? ghost_plan(test::slabs(), of_last, MPI_COMM_WORLD, {})
                   : ghost_plan(test::slabs(), Points(x, 2), MPI_COMM_WORLD, {.cutoff = radii});
    };
    EXPECT_NO_THROW(find(Points({}, 2)));
    EXPECT_THROW(find(Points(x, 2)), Error);
    test::expect_same_error(
        [&] {
            const Points points(x, 2);
            is_last_rank() ? ghost_plan(test::slabs(), points, MPI_COMM_WORLD, {.cutoff = 1})
                           : ghost_plan(test::slabs(), points, MPI_COMM_WORLD, {.cutoff = radii});
        },
        "whether each point has a cutoff differs between rank 0 and rank " +
            std::to_string(num_ranks() - 1) + "; give one for each point");
}

}  // namespace
}  // namespace rrcb
