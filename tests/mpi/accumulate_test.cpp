#include "../support/same_error.hpp"
#include "held_points.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/ghosts.hpp>

namespace rrcb {
namespace {

constexpr double radius = 0.3;
constexpr std::size_t num_points = 300;

/// A cloud that every rank knows, the points of this rank by number, and their ghosts.
struct Scene {
    std::vector<double> positions = test::uniform_cloud(num_points, 2, 5);
    std::vector<std::int64_t> mine;
    std::vector<std::int64_t> near;
    GhostPlan plan;
};

Scene make_scene() {
    Scene scene;
    test::HeldPoints all{2, scene.positions};
    const Cuts cuts = test::divide_on_each_rank(all, num_ranks()).cuts;
    const test::Share here(all);
    scene.mine.assign(here.indices.begin(), here.indices.end());
    scene.plan = ghost_plan(cuts, here.points(), MPI_COMM_WORLD, {.cutoff = radius});
    scene.near = fetch(scene.plan, scene.mine, MPI_COMM_WORLD);
    return scene;
}

/// The force of point i on point j.
double force(const Scene& scene, std::int64_t i, std::int64_t j) {
    const auto at = [&](std::int64_t k) {
        return &scene.positions[2 * static_cast<std::size_t>(k)];
    };
    const double apart = std::hypot(at(i)[0] - at(j)[0], at(i)[1] - at(j)[1]);
    return i != j && apart <= radius ? 1 / (0.01 + apart) : 0;
}

/// What the points of this rank do to some points: forces, and how many they are.
struct Effects {
    std::vector<double> forces;
    std::vector<float> halves;
    std::vector<std::int32_t> counts;  ///< two for each
    std::vector<std::uint8_t> seen;
};

Effects effects_on(const std::vector<std::int64_t>& points, const Scene& scene) {
    Effects effects;
    for (const std::int64_t j : points) {
        double sum = 0;
        std::int32_t count = 0;
        for (const std::int64_t i : scene.mine) {
            sum += force(scene, i, j);
            count += force(scene, i, j) > 0 ? 1 : 0;
        }
        effects.forces.push_back(sum);
        effects.halves.push_back(static_cast<float>(sum / 2));
        effects.counts.insert(effects.counts.end(), {count, 2 * count});
        effects.seen.push_back(1);
    }
    return effects;
}

auto columns_of(const Effects& effects) {
    return columns(effects.forces, effects.halves, column(effects.counts, 2), effects.seen);
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST(Accumulate, adds_what_all_ranks_did_to_each_point) {
    const Scene scene = make_scene();
    const Effects here = effects_on(scene.mine, scene);
    const Effects there = effects_on(scene.near, scene);
    const auto [forces, halves, counts, seen] =
        accumulate(scene.plan, columns_of(there), columns_of(here), MPI_COMM_WORLD);
    ASSERT_EQ(forces.size(), scene.mine.size());
    for (std::size_t k = 0; k < scene.mine.size(); ++k) {
        double sum = 0;
        std::int32_t count = 0;
        for (std::int64_t i = 0; i < static_cast<std::int64_t>(num_points); ++i) {
            sum += force(scene, i, scene.mine[k]);
            count += force(scene, i, scene.mine[k]) > 0 ? 1 : 0;
        }
        EXPECT_NEAR(forces[k], sum, 1e-12 * sum);
        EXPECT_NEAR(halves[k], sum / 2, 1e-6 * sum);
        EXPECT_EQ(counts[2 * k], count);
        EXPECT_EQ(counts[2 * k + 1], 2 * count);
        const auto copies = std::ranges::count(scene.plan.send_indices, k);
        EXPECT_EQ(seen[k], 1 + copies);
    }
}

TEST(Accumulate, gives_the_same_bits_by_ascending_rank) {
    const Scene scene = make_scene();
    const Effects here = effects_on(scene.mine, scene);
    const Effects there = effects_on(scene.near, scene);
    const auto once = accumulate(scene.plan, there.forces, here.forces, MPI_COMM_WORLD);
    TransferReport report;
    const auto in_pieces = accumulate(scene.plan, there.forces, here.forces, MPI_COMM_WORLD,
                                      {.max_bytes = 100, .report = &report});
    EXPECT_TRUE(same_bits(once, in_pieces));
    EXPECT_LE(report.peak_bytes, 100u);
    // What each rank did to all points, added in the stated order.
    std::vector<std::int64_t> all(num_points);
    std::iota(all.begin(), all.end(), std::int64_t{0});
    const std::vector<double> mine = effects_on(all, scene).forces;
    std::vector<double> each(num_points * static_cast<std::size_t>(num_ranks()));
    MPI_Allgather(mine.data(), static_cast<int>(num_points), MPI_DOUBLE, each.data(),
                  static_cast<int>(num_points), MPI_DOUBLE, MPI_COMM_WORLD);
    std::vector<double> sums = here.forces;
    for (std::size_t there_rank = 0; there_rank < static_cast<std::size_t>(num_ranks());
         ++there_rank) {
        if (static_cast<int>(there_rank) == rank()) continue;
        for (std::size_t k = 0; k < sums.size(); ++k)
            sums[k] += each[there_rank * num_points + static_cast<std::size_t>(scene.mine[k])];
    }
    EXPECT_TRUE(same_bits(once, sums));
}

TEST(Accumulate, takes_arrays_and_columns_of_no_points) {
    const std::vector<double> none;
    const Scene scene = make_scene();
    GhostPlan nothing;
    EXPECT_TRUE(accumulate(nothing, none, none, MPI_COMM_WORLD).empty());
    const std::vector<int> of_ghosts(3 * scene.near.size(), 1);
    const std::vector<int> of_points(3 * scene.mine.size(), 1);
    const std::vector<int> sums =
        accumulate(scene.plan, column(of_ghosts, 3), column(of_points, 3), MPI_COMM_WORLD);
    EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), std::size_t{0}),
              3 * (scene.mine.size() + scene.plan.send_indices.size()));
}

TEST(Accumulate, of_columns_of_a_wrong_length_on_one_rank_is_refused_on_all) {
    const Scene scene = make_scene();
    const auto refused = [&](const std::string& text, std::size_t more_ghosts,
                             std::size_t more_points, std::size_t components) {
        const std::size_t last = is_last_rank() ? 1 : 0;
        const std::vector<double> of_ghosts(2 * scene.near.size() + last * more_ghosts);
        const std::vector<double> of_points(2 * scene.mine.size() + last * more_points);
        test::expect_same_error(
            [&] {
                accumulate(scene.plan, column(of_ghosts, 2),
                           column(of_points, last == 1 ? components : 2), MPI_COMM_WORLD);
            },
            "rank " + std::to_string(num_ranks() - 1) + ": " + text);
    };
    refused("a column has", 1, 0, 2);
    refused("a column has", 0, 2, 2);
    refused("columns of ghosts must have as many components", 0, 0, 1);
    EXPECT_EQ(fetch(scene.plan, scene.mine, MPI_COMM_WORLD), scene.near);
}

TEST(Reply, returns_the_rows_of_each_rank_to_the_points_that_it_has_as_ghosts) {
    struct Answer {
        std::int64_t of;
        int by;
        float third;
    };
    const Scene scene = make_scene();
    std::vector<Answer> answers;
    for (const std::int64_t i : scene.near)
        answers.push_back({i, rank(), static_cast<float>(i) / 3});
    const std::vector<Answer> found = reply(scene.plan, answers, MPI_COMM_WORLD);
    ASSERT_EQ(found.size(), scene.plan.send_indices.size());
    std::size_t k = 0;
    for (const RankCount& share : scene.plan.send)
        for (LocalIndex n = 0; n < share.count; ++n, ++k) {
            const std::int64_t i = scene.mine[scene.plan.send_indices[k]];
            EXPECT_EQ(found[k].of, i);
            EXPECT_EQ(found[k].by, share.rank);
            EXPECT_EQ(found[k].third, static_cast<float>(i) / 3);
        }
    const auto [again, twice] =
        reply(scene.plan, columns(scene.near, column(scene.near)), MPI_COMM_WORLD);
    EXPECT_EQ(again, twice);
    answers.resize(answers.size() + (is_last_rank() ? 1 : 0));
    EXPECT_THROW(static_cast<void>(reply(make_scene().plan, answers, MPI_COMM_WORLD)), Error);
}

}  // namespace
}  // namespace rrcb
