#include "../support/distance.hpp"
#include "../support/same_error.hpp"
#include "held_points.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/groups.hpp>

namespace rrcb {
namespace {

/// Points that every rank knows, and their groups.
struct Scene : test::HeldPoints {
    explicit Scene(int dimension_of_points) { dimension = dimension_of_points; }

    std::vector<std::uint64_t> keys{};

    Vector position(std::size_t i) const { return Points(coordinates, dimension).position(i); }
};

/// What this rank has of a scene.
struct Share : test::Share {
    explicit Share(const Scene& scene) : test::Share(scene) {
        for (const std::size_t i : indices) keys.push_back(scene.keys[i]);
    }

    std::vector<std::uint64_t> keys{};
};

/// Groups of up to `most` points near each other, a fifth of the points without; every third rank
/// is empty.
Scene make_scene(int dimension, std::size_t num_points, std::size_t most, unsigned seed) {
    Scene scene(dimension);
    scene.coordinates = test::uniform_cloud(num_points, dimension, seed);
    std::mt19937_64 engine(seed + 1);
    const auto d = static_cast<std::size_t>(dimension);
    std::uint64_t key = 0;
    std::size_t left = 0;
    for (std::size_t i = 0; i < num_points; ++i) {
        if (left == 0) {
            key = engine() >> 1;
            left = 1 + engine() % most;
        } else {
            for (std::size_t a = 0; a < d; ++a)
                scene.coordinates[i * d + a] = scene.coordinates[(i - 1) * d + a] + 0.001;
            --left;
        }
        scene.keys.push_back(engine() % 5 == 0 ? no_group : key);
        scene.weights.push_back(test::uniform(engine, 0.5, 1.5));
        int to = static_cast<int>(engine() % static_cast<std::uint64_t>(num_ranks()));
        if (to % 3 == 1 && num_ranks() > 2) to = 0;
        scene.owners.push_back(to);
    }
    return scene;
}

/// Points of each group by rank; those without have a group each.
std::vector<std::vector<std::size_t>> expected_groups(const Scene& scene) {
    std::map<std::uint64_t, std::vector<std::size_t>> by_key;
    std::vector<std::vector<std::size_t>> all;
    for (int r = 0; r < num_ranks(); ++r) {
        for (std::size_t i = 0; i < scene.count(); ++i) {
            if (scene.owners[i] != r) continue;
            if (scene.keys[i] == no_group) all.push_back({i});
            if (scene.keys[i] != no_group) by_key[scene.keys[i]].push_back(i);
        }
    }
    for (const auto& [key, points] : by_key) all.push_back(points);
    return all;
}

Vector centre_of(const Scene& scene, const std::vector<std::size_t>& group) {
    Vector centre{};
    double weight = 0;
    for (const std::size_t i : group) weight += scene.weights[i];
    for (const std::size_t i : group)
        for (std::size_t a = 0; a < max_dimension; ++a)
            centre[a] += scene.weights[i] / weight * scene.position(i)[a];
    return centre;
}

/// Compares the group of each point with that of all points gathered.
void expect_groups(const Scene& scene, GroupPlace place) {
    const Share mine(scene);
    const Groups found = groups(mine.points(), mine.keys, MPI_COMM_WORLD, place);
    const auto d = static_cast<std::size_t>(scene.dimension);
    const std::vector<double> places =
        to_points(found, column(found.coordinates, d), MPI_COMM_WORLD);
    const std::vector<double> weights = to_points(found, found.weights, MPI_COMM_WORLD);
    ASSERT_EQ(weights.size(), mine.indices.size());
    std::vector<double> squares;
    for (const double weight : mine.weights) {
        squares.push_back(1);
        squares.push_back(weight * weight);
    }
    const std::vector<double> sums_of_groups = group_sums(found, squares, MPI_COMM_WORLD, 2);
    const std::vector<double> summed = to_points(found, column(sums_of_groups, 2), MPI_COMM_WORLD);
    std::size_t owned = 0;
    for (const std::vector<std::size_t>& group : expected_groups(scene)) {
        owned += scene.owners[group[0]] == rank() ? 1 : 0;
        const Vector centre =
            place == GroupPlace::centre ? centre_of(scene, group) : scene.position(group[0]);
        double weight = 0;
        double square = 0;
        for (const std::size_t i : group) weight += scene.weights[i];
        for (const std::size_t i : group) square += scene.weights[i] * scene.weights[i];
        for (const std::size_t i : group) {
            if (scene.owners[i] != rank()) continue;
            const auto k =
                static_cast<std::size_t>(std::ranges::find(mine.indices, i) - mine.indices.begin());
            EXPECT_NEAR(weights[k], weight, 1e-12 * weight);
            EXPECT_EQ(summed[2 * k], static_cast<double>(group.size()));
            EXPECT_NEAR(summed[2 * k + 1], square, 1e-12 * square);
            for (std::size_t a = 0; a < d; ++a)
                EXPECT_NEAR(places[k * d + a], centre[a],
                            place == GroupPlace::centre ? 1e-14 : 0.0);
        }
    }
    EXPECT_EQ(found.points().count, owned);
}

TEST(Groups, are_those_of_the_gathered_points) {
    for (const GroupPlace place : {GroupPlace::centre, GroupPlace::first_point})
        for (int dimension = 1; dimension <= 3; ++dimension)
            for (const std::size_t most : {1u, 4u, 60u})
                expect_groups(make_scene(dimension, 500, most, 3), place);
}

TEST(Groups, hold_all_points_or_one_point_of_each_rank) {
    Scene scene = make_scene(2, 300, 3, 5);
    std::ranges::fill(scene.keys, 0);
    expect_groups(scene, GroupPlace::centre);
    std::ranges::fill(scene.keys, no_group);
    expect_groups(scene, GroupPlace::centre);
    for (std::size_t i = 0; i < scene.count(); ++i) scene.keys[i] = i % 17;
    expect_groups(scene, GroupPlace::first_point);
    expect_groups(Scene(3), GroupPlace::centre);
}

/// Checks that points of a group share their part, that parts are those of the groups' places, and
/// the weights of the parts.
void expect_whole(const Scene& scene, const Groups& found, const Balance& result) {
    const Share mine(scene);
    const std::vector<Part> parts = to_points(found, result.parts, MPI_COMM_WORLD);
    EXPECT_EQ(assign(result.cuts, found.points(), MPI_COMM_WORLD), result.parts);
    std::vector<int> all(scene.count(), 0);
    for (std::size_t k = 0; k < parts.size(); ++k) all[mine.indices[k]] = parts[k] + 1;
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_INT, MPI_SUM,
                  MPI_COMM_WORLD);
    std::vector<double> weights(static_cast<std::size_t>(result.cuts.num_parts));
    for (const std::vector<std::size_t>& group : expected_groups(scene)) {
        for (const std::size_t i : group) {
            ASSERT_EQ(all[i], all[group[0]]);
            weights.at(static_cast<std::size_t>(all[i] - 1)) += scene.weights[i];
        }
    }
    double total = 0;
    for (const double weight : weights) total += weight;
    const double imbalance =
        std::ranges::max(weights) * static_cast<double>(weights.size()) / total;
    EXPECT_NEAR(result.report.imbalance, imbalance, 1e-9);
}

TEST(Groups, stay_whole_in_balances) {
    const Scene scene = make_scene(2, 2000, 5, 11);
    const Share mine(scene);
    for (const GroupPlace place : {GroupPlace::centre, GroupPlace::first_point}) {
        const Groups found = groups(mine.points(), mine.keys, MPI_COMM_WORLD, place);
        const Balance first = balance(found.points(), MPI_COMM_WORLD);
        expect_whole(scene, found, first);
        EXPECT_LT(first.report.imbalance, 1.1);
        const Balance next =
            balance(found.points(), MPI_COMM_WORLD, {.refine = Refine::exact}, first.cuts);
        expect_whole(scene, found, next);
        const Groups again = groups(mine.points(), mine.keys, MPI_COMM_WORLD, place);
        EXPECT_EQ(again.coordinates, found.coordinates);
        EXPECT_EQ(again.weights, found.weights);
        EXPECT_EQ(again.of_points, found.of_points);
    }
}

TEST(Groups, heavier_than_a_part_are_reported) {
    Scene scene = make_scene(2, 600, 3, 11);
    for (std::size_t i = 0; i < scene.count() / 2; ++i) scene.keys[i] = 1;
    const Share mine(scene);
    const Groups found = groups(mine.points(), mine.keys, MPI_COMM_WORLD);
    const Balance result = balance(found.points(), MPI_COMM_WORLD, {.num_parts = 8});
    expect_whole(scene, found, result);
    EXPECT_GT(result.report.imbalance, 3.5);
    EXPECT_GT(result.report.details.least_imbalance, 3.5);
}

TEST(Groups, without_weight_are_at_the_mean_of_their_points) {
    const double huge = std::numeric_limits<double>::max();
    const std::vector<double> x{-huge, huge, 1.0, 3.0};
    const std::vector<double> weights{1, 1, 0, 0};
    const std::vector<std::uint64_t> keys{7, 7, 8, 8};
    const Groups found = groups(Points(x, 1, weights), keys, MPI_COMM_SELF);
    EXPECT_EQ(found.coordinates, (std::vector{0.0, 2.0}));
    EXPECT_EQ(found.weights, (std::vector{2.0, 0.0}));
}

template <class AnyGroups>
concept GivesPoints = requires(AnyGroups&& groups) {
    std::forward<AnyGroups>(groups).points();
};
static_assert(GivesPoints<const Groups&> && !GivesPoints<Groups>);

/// Counts the pairs of points nearer than `radius` that are on neither rank of the two.
std::size_t missing_pairs(const Scene& scene, const std::vector<int>& owners, const GhostPlan& plan,
                          const std::vector<std::size_t>& here, double radius) {
    const std::vector<std::size_t> near = fetch(plan, here, MPI_COMM_WORLD);
    const std::size_t count = scene.count();
    std::vector<int> meets(count * count);
    for (const std::size_t i : here)
        for (const std::size_t j : near) meets[std::min(i, j) * count + std::max(i, j)] = 1;
    MPI_Allreduce(MPI_IN_PLACE, meets.data(), static_cast<int>(meets.size()), MPI_INT, MPI_MAX,
                  MPI_COMM_WORLD);
    std::size_t missing = 0;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) {
            const Vector x = scene.position(i), y = scene.position(j);
            if (owners[i] == owners[j] || std::hypot(x[0] - y[0], x[1] - y[1]) > radius) continue;
            missing += meets[i * count + j] == 0 ? 1 : 0;
        }
    return missing;
}

TEST(Groups, need_a_radius_greater_by_their_points_distance_from_the_region) {
    Scene scene(2);
    scene.coordinates = test::uniform_cloud(600, 2, 21);
    for (std::size_t i = 0; i < 600; ++i) scene.keys.push_back(i / 6);  // each all over the box
    scene.weights.assign(600, 1);
    scene.owners.assign(600, 0);
    const Share first(scene);
    const Points points = first.points();
    const std::vector<std::uint64_t>& keys = first.keys;
    const MPI_Comm comm = MPI_COMM_WORLD;
    rrcb::Balance balance;
    const rrcb::Groups bonds = rrcb::groups(points, keys, comm);
    balance = rrcb::balance(bonds.points(), comm, {}, balance.cuts);
    const std::vector<rrcb::Part> parts = rrcb::to_points(bonds, balance.parts, comm);
    const rrcb::Plan plan = rrcb::plan(parts, balance.cuts.num_parts, comm);
    const std::vector<std::size_t> numbers = transfer(plan, first.indices, comm);
    std::vector<int> owners(600);
    for (const std::size_t i : numbers) owners[i] = rank();
    MPI_Allreduce(MPI_IN_PLACE, owners.data(), 600, MPI_INT, MPI_SUM, comm);
    scene.owners = owners;
    const Share mine(scene);
    const Box region = box_of(balance.cuts, rank());
    double farthest = 0;
    for (const std::size_t i : mine.indices)
        farthest =
            std::max(farthest, static_cast<double>(test::distance(scene.position(i), region, 2)));
    MPI_Allreduce(MPI_IN_PLACE, &farthest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    const auto missing = [&](double greater) {
        const GhostPlan near = ghost_plan(balance.cuts, mine.points(), comm, {.cutoff = greater});
        return missing_pairs(scene, owners, near, mine.indices, 0.03);
    };
    EXPECT_EQ(missing(0.03 + farthest), 0u);
    const std::size_t with_less = missing(0.03);
    EXPECT_EQ(with_less > 0, num_ranks() > 2);  // two regions leave no gap
}

void expect_refusal(const std::string& text, const std::function<void()>& call) {
    test::expect_same_error(call, text);
}

TEST(Groups, that_do_not_fit_on_one_rank_are_refused_on_all) {
    const std::vector<double> x{rank() + 0.5, 0, rank() + 0.6, 0};
    const std::vector<std::uint64_t> keys{1, 2};
    const std::vector<std::uint64_t> none;
    const bool last = is_last_rank();
    expect_refusal("keys must have one entry for each point",
                   [&] { groups(Points(x, 2), last ? none : keys, MPI_COMM_WORLD); });
    const std::vector<double> wrong{0, std::nan(""), 0, 0};
    expect_refusal("is NaN or infinite",
                   [&] { groups(Points(last ? wrong : x, 2), keys, MPI_COMM_WORLD); });
    const Groups right = groups(Points(x, 2), keys, MPI_COMM_WORLD);
    expect_refusal("groups of this rank", [&] {
        to_points(right, last ? std::vector<int>(7) : std::vector<int>(right.points().count),
                  MPI_COMM_WORLD);
    });
    expect_refusal("a column has",
                   [&] { group_sums(right, std::vector<double>(last ? 3 : 2), MPI_COMM_WORLD); });
    expect_refusal("of_points of the groups", [&] {
        Groups spoiled = right;
        if (last) spoiled.of_points[0] = 1000;
        to_points(spoiled, std::vector<int>(right.points().count), MPI_COMM_WORLD);
    });
    if (num_ranks() == 1) return;
    expect_refusal("the place of groups differs", [&] {
        groups(Points(x, 2), keys, MPI_COMM_WORLD,
               last ? GroupPlace::first_point : GroupPlace::centre);
    });
    expect_refusal("the dimension differs", [&] {
        const std::vector<std::uint64_t> four(4, 3);
        groups(Points(x, last ? 1 : 2), last ? four : keys, MPI_COMM_WORLD);
    });
}

TEST(Groups, of_weights_that_overflow_are_refused_on_all) {
    if (num_ranks() == 1) GTEST_SKIP() << "the sum overflows on several ranks";
    const std::vector<double> x(2), weights{std::numeric_limits<double>::max()};
    const std::vector<std::uint64_t> keys{7};
    expect_refusal("the sum of the weights of a group overflows",
                   [&] { groups(Points(x, 2, weights), keys, MPI_COMM_WORLD); });
}

}  // namespace
}  // namespace rrcb
