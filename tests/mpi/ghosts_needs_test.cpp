// Ghosts by the radii of their receivers, compared with all pairs of points and images.
#include "../support/distance.hpp"
#include "../support/same_error.hpp"
#include "held_points.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>
#include <rrcb/experimental/verify.hpp>
#include <rrcb/ghosts.hpp>

namespace rrcb {
namespace {

using test::distance;

constexpr Box unit{{0, 0, 0}, {1, 1, 1}};

/// Points and radii that every rank knows, and those of this rank by number.
struct Scene {
    int dimension;
    int num_parts;
    std::vector<double> positions;
    std::vector<double> radii;
    Cuts cuts{};
    std::vector<Part> parts{};
    std::vector<int> mine{};
    std::vector<double> here{};
    std::vector<double> radii_here{};

    int count() const { return static_cast<int>(radii.size()); }
    double radius(int i) const { return radii[static_cast<std::size_t>(i)]; }
    bool has(int i) const { return std::ranges::binary_search(mine, i); }
    Points points() const { return Points(here, dimension); }
    RankRange ranks_of(Part part) const { return ranks_of_part(part, num_parts, num_ranks()); }
    /// Returns whether this rank holds the part of a point.
    bool holds_part_of(int i) const {
        return ranks_of(parts[static_cast<std::size_t>(i)]).contains(rank());
    }
    Vector position(int i, const Shift& shift = {}) const {
        Vector x = Points(positions, dimension).position(static_cast<LocalIndex>(i));
        for (std::size_t a = 0; a < 3; ++a) x[a] += shift[a];
        return x;
    }
    /// Returns whether two points are at most so far apart, by few operations.
    bool are_within(double radius, int i, int j) const {
        double square = 0;
        for (int a = 0; a < dimension; ++a) {
            const double apart = positions[static_cast<std::size_t>(i * dimension + a)] -
                                 positions[static_cast<std::size_t>(j * dimension + a)];
            square += apart * apart;
        }
        return square <= radius * radius;
    }
    long double apart(int i, int j, const Shift& shift) const {
        const Vector x = position(i);
        return distance(position(j, shift), Box{x, x}, dimension);
    }
};

Scene make_scene(int dimension, int num_parts, std::vector<double> positions,
                 std::vector<double> radii) {
    Scene scene{dimension, num_parts, std::move(positions), std::move(radii)};
    test::HeldPoints all{dimension, scene.positions, scene.radii};
    const Balance whole = test::divide_on_each_rank(all, num_parts);
    scene.cuts = whole.cuts;
    scene.parts = whole.parts;
    const test::Share mine(all);
    scene.mine.assign(mine.indices.begin(), mine.indices.end());
    scene.here = mine.coordinates;
    scene.radii_here = mine.weights;
    return scene;
}

Scene random_scene(int dimension, int num_parts) {
    std::vector<double> radii;
    for (std::size_t i = 0; i < 80; ++i)
        radii.push_back(std::vector{0.0, 0.02, 0.05, 0.1, 0.4}[i * i % 5]);
    return make_scene(dimension, num_parts,
                      test::uniform_cloud(80, dimension, static_cast<unsigned>(dimension)), radii);
}

std::vector<Shift> shifts_of(const Scene& scene, bool is_periodic) {
    std::vector<Shift> shifts{Shift{}};
    for (std::size_t a = 0; is_periodic && a < static_cast<std::size_t>(scene.dimension); ++a)
        for (std::size_t k = shifts.size(); k-- > 0;)
            for (const int by : {-1, 1}) {
                shifts.push_back(shifts[k]);
                shifts.back()[a] = by;
            }
    return shifts;
}

double radius_of_pair(const Scene& scene, int receiver, int sender, Needs needs) {
    if (needs == Needs::scatter) return scene.radius(sender);
    if (needs == Needs::gather) return scene.radius(receiver);
    return std::max(scene.radius(receiver), scene.radius(sender));
}

/// Expects a point or image that a pair needs once, others once at most and never beyond the
/// greatest radius of a part.
void expect_ghosts(const Scene& scene, Needs needs, bool is_periodic) {
    GhostOptions options{.cutoff = scene.radii_here, .needs = needs};
    if (is_periodic) options.periodic = unit;
    const GhostPlan plan = ghost_plan(scene.cuts, scene.points(), MPI_COMM_WORLD, options);
    const std::vector<int> numbers = fetch(plan, scene.mine, MPI_COMM_WORLD);
    const experimental::VerifyOptions sample{.cutoff = scene.radii_here};
    EXPECT_EQ(experimental::verify(plan, scene.points(), MPI_COMM_WORLD, sample).num_faults, 0);
    std::map<std::pair<int, Shift>, int> found;
    for (std::size_t k = 0; k < numbers.size(); ++k)
        ++found[{numbers[k], is_periodic ? plan.shifts[k] : Shift{}}];
    for (const Shift& shift : shifts_of(scene, is_periodic))
        for (int j = 0; j < scene.count(); ++j) {
            if (scene.has(j) && shift == Shift{}) continue;
            bool is_needed = false;
            bool may_come = false;
            for (int i = 0; i < scene.count(); ++i) {
                if (!scene.holds_part_of(i)) continue;
                const double radius = radius_of_pair(scene, i, j, needs);
                is_needed = is_needed || scene.apart(i, j, shift) <= radius;
                const Box region = box_of(scene.cuts, scene.parts[static_cast<std::size_t>(i)]);
                const long double apart =
                    distance(scene.position(j, shift), region, scene.dimension);
                may_come = may_come || apart <= radius * (1 + 1e-14);
                // All that a sender's own radius reaches, although no point may be there.
                if (needs == Needs::scatter && !is_periodic)
                    is_needed = is_needed || apart <= radius;
            }
            const int count = found[{j, shift}];
            EXPECT_EQ(count, is_needed || count > 0 ? 1 : 0) << j;
            EXPECT_TRUE(may_come || count == 0) << j;
        }
}

TEST(GhostsThatNeed, a_radius_of_sender_or_receiver_are_those_of_all_pairs) {
    for (const int dimension : {1, 2, 3})
        for (const Needs needs : {Needs::scatter, Needs::gather, Needs::symmetric})
            for (const bool is_periodic : {false, true})
                expect_ghosts(random_scene(dimension, num_ranks()), needs, is_periodic);
}

TEST(GhostsThatNeed, a_radius_come_to_several_parts_and_to_ranks_that_share_one) {
    for (const int num_parts : {2 * num_ranks() + 1, (num_ranks() + 1) / 2})
        for (const Needs needs : {Needs::gather, Needs::symmetric})
            expect_ghosts(random_scene(2, num_parts), needs, true);
}

TEST(GhostsThatNeed, the_radius_of_the_receiver_come_to_one_side_only) {
    if (num_ranks() != 2) GTEST_SKIP() << "needs two ranks";
    Scene scene = make_scene(1, 2, {0.4, 0.6}, {0.3, 0.05});
    scene.cuts.tree[0].at[0] = 0.5;
    const auto count = [&](Needs needs) {
        const GhostPlan plan = ghost_plan(scene.cuts, scene.points(), MPI_COMM_WORLD,
                                          {.cutoff = scene.radii_here, .needs = needs});
        return fetch(plan, scene.mine, MPI_COMM_WORLD).size();
    };
    EXPECT_EQ(count(Needs::gather), rank() == 0 ? 1u : 0u);
    EXPECT_EQ(count(Needs::scatter), rank() == 0 ? 0u : 1u);
    EXPECT_EQ(count(Needs::symmetric), 1u);
}

TEST(GhostsThatNeed, ten_times_the_radius_in_a_corner_are_few) {
    for (const int dimension : {1, 2, 3}) {
        const std::size_t count = dimension == 3 ? 3000 : 2000;
        const std::vector<double> cloud =
            test::uniform_cloud(count, dimension, static_cast<unsigned>(dimension));
        const Points points(cloud, dimension);
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t i = 0; i < count; ++i) {
            const Vector x = points.position(i);
            order.emplace_back(*std::ranges::max_element(x), i);
        }
        std::ranges::sort(order);
        const double radius =
            std::vector{0.01, 0.07, 0.14}[static_cast<std::size_t>(dimension - 1)];
        std::vector<double> radii(count, radius);
        for (std::size_t k = 0; k < count / 100; ++k) radii[order[k].second] = 10 * radius;
        for (const Needs needs : {Needs::gather, Needs::symmetric}) {
            const Scene scene = make_scene(dimension, num_ranks(), cloud, radii);
            const GhostPlan plan = ghost_plan(scene.cuts, scene.points(), MPI_COMM_WORLD,
                                              {.cutoff = scene.radii_here, .needs = needs});
            std::array<int, 2> totals{};
            for (int j = 0; j < scene.count(); ++j) {
                if (scene.has(j)) continue;
                totals[0] += std::ranges::any_of(scene.mine, [&](int i) {
                    return scene.are_within(radius_of_pair(scene, i, j, needs), i, j);
                });
            }
            for (const RankCount& from : plan.receive) totals[1] += static_cast<int>(from.count);
            MPI_Allreduce(MPI_IN_PLACE, totals.data(), 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
            EXPECT_GE(totals[1], totals[0]);
            EXPECT_LE(totals[1], 1.2 * totals[0]) << dimension;
        }
    }
}

TEST(GhostsThatNeed, something_else_on_another_rank_are_refused) {
    const Scene scene = random_scene(2, num_ranks());
    const auto find = [&](Needs needs) {
        ghost_plan(scene.cuts, scene.points(), MPI_COMM_WORLD,
                   {.cutoff = scene.radii_here, .needs = needs});
    };
    test::expect_same_error([&] { find(static_cast<Needs>(3)); },
                            "needs must be scatter, gather or symmetric");
    if (num_ranks() == 1) return;
    test::expect_same_error(
        [&] { find(is_last_rank() ? Needs::gather : Needs::scatter); },
        "needs differs between rank 0 and rank " + std::to_string(num_ranks() - 1));
}

}  // namespace
}  // namespace rrcb
