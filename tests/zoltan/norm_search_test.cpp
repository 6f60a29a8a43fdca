// The search for one cut, against all cuts there are.
#include "zoltan/norm/norm_search.hpp"

#include "zoltan/norm/norm_objects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace rrcb::zoltan {
namespace {

struct Objects {
    int dimension = 1;
    std::vector<double> coordinates;
    std::vector<Load> loads;

    Points points() const { return interleaved_points(coordinates, dimension); }
    Load all() const {
        Load sum{};
        for (const Load& load : loads) sum = sum + load;
        return sum;
    }
};

Aim aim_for(const Objects& objects, int norm, int num_weights, double share) {
    const Load all = objects.all();
    Factors values{};
    for (std::size_t k = 0; k < std::size_t(num_weights); ++k)
        if (all[k] > 0) values[k] = 1 / double(all[k]);
    std::array<double, most_weights> shares{};
    shares.fill(share);
    return aim_of(norm, values, shares, all);
}

struct Found {
    NormSearch search;
    int rounds;
};

/// Runs the search on one rank.
Found search_for(const Objects& objects, const Aim& aim, int axis, int num_axes, int num_slots) {
    const Points points = objects.points();
    NormObjects mine(points, objects.loads);
    Found found{NormSearch(axis, num_axes, aim), 0};
    NormSearch& search = found.search;
    std::size_t length = mine.list(mine.all(), axis);
    while (!search.is_done()) {
        const auto list = mine.listed(mine.all(), axis, length);
        const int along = search.current_axis();
        if (!search.narrow(mine.key_range(list, along))) continue;
        ++found.rounds;
        const Bins bins = search.bins(num_slots);
        std::vector<Load> slots(static_cast<std::size_t>(num_slots));
        mine.count(list, along, bins, slots);
        length = mine.keep(mine.all(), axis, length, along, bins, search.choose(slots));
    }
    return found;
}

/// Smallest larger norm of all cuts between objects in the order in which a cut tells them apart.
double best_of_all(const Objects& objects, const Aim& aim, int axis, bool plain) {
    const Points points = objects.points();
    std::vector<std::size_t> order(objects.loads.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto place = [&](std::size_t i) {
        std::vector<double> values{points.coordinate(i, axis)};
        for (int a = 0; a < points.dimension && !plain; ++a)
            if (a != axis) values.push_back(points.coordinate(i, a));
        return values;
    };
    std::sort(order.begin(), order.end(), [&](auto i, auto j) { return place(i) < place(j); });
    Load below{};
    double best = larger_norm(aim, below);
    for (std::size_t k = 0; k < order.size(); ++k) {
        below = below + objects.loads[order[k]];
        if (k + 1 == order.size() || place(order[k]) != place(order[k + 1]))
            best = std::min(best, larger_norm(aim, below));
    }
    return best;
}

Load load_below(const Objects& objects, const Cut& cut) {
    const Points points = objects.points();
    Load below{};
    for (LocalIndex i = 0; i < points.count; ++i)
        if (!is_above(cut, points.position(i), points.dimension)) below = below + objects.loads[i];
    return below;
}

Load random_load(std::mt19937& random, int num_weights) {
    Load load{};
    for (std::size_t k = 0; k < std::size_t(num_weights); ++k)
        load[k] = random() % 4 == 0 ? 0 : std::int64_t(random() % 1000);
    load[most_weights] = 1;
    return load;
}

void expect_the_best(const Objects& objects, const Aim& aim, int axis, bool plain) {
    const double best = best_of_all(objects, aim, axis, plain);
    for (const int num_slots : {2, 8, 128}) {
        const int num_axes = plain ? 1 : objects.dimension;
        const Found found = search_for(objects, aim, axis, num_axes, num_slots);
        EXPECT_EQ(larger_norm(aim, found.search.below()), best);
        EXPECT_EQ(load_below(objects, found.search.cut()), found.search.below());
    }
}

TEST(NormSearch, finds_the_best_cut_of_a_line) {
    std::mt19937 random(1);
    for (int round = 0; round < 600; ++round) {
        const int num_weights = 1 + round % 4;
        const int norm = 1 + round / 4 % 3;
        Objects objects;
        const int count = 1 + int(random() % 30);
        for (int i = 0; i < count; ++i) {
            // Often in one place, often apart.
            objects.coordinates.push_back(round % 2 == 0 ? double(random() % 7)
                                                         : double(random()) * 1e-3 - 1e6);
            objects.loads.push_back(random_load(random, num_weights));
        }
        const double share = std::array{0.5, 1.0 / 3, 0.9, 0.01}[random() % 4];
        expect_the_best(objects, aim_for(objects, norm, num_weights, share), 0, round % 3 == 0);
    }
}

TEST(NormSearch, breaks_ties_by_the_other_axes_or_keeps_planes_together) {
    std::mt19937 random(2);
    for (int round = 0; round < 300; ++round) {
        Objects objects{2 + round % 2, {}, {}};
        const int count = 1 + int(random() % 60);
        for (int i = 0; i < count; ++i) {
            for (int a = 0; a < objects.dimension; ++a)
                objects.coordinates.push_back(double(random() % 3));
            objects.loads.push_back(random_load(random, 3));
        }
        const Aim aim = aim_for(objects, 1 + round % 3, 3, 0.5);
        for (int axis = 0; axis < objects.dimension; ++axis)
            expect_the_best(objects, aim, axis, round % 5 == 0);
    }
}

TEST(NormSearch, takes_few_rounds_whatever_the_cloud) {
    std::mt19937 random(3);
    int most = 0;
    for (int round = 0; round < 60; ++round) {
        Objects objects;
        for (int i = 0; i < 3000; ++i) {
            const double u = double(random()) / double(random.max());
            double x = std::pow(10, -300 + 600 * u);
            if (round % 4 == 1) x = u * 1e-3 + 1e9;
            if (round % 4 == 2) x = (u - 0.5) * DBL_MAX * 2;
            if (round % 4 == 3) x = i == 0 ? 1e300 : std::nextafter(1.0, 2) * (1 + 1e-15 * u);
            objects.coordinates.push_back(round % 8 < 4 ? x : -x);
            objects.loads.push_back(random_load(random, 2));
        }
        const Aim aim = aim_for(objects, 3, 2, 0.5);
        const Found found = search_for(objects, aim, 0, 1, 8);
        EXPECT_EQ(larger_norm(aim, found.search.below()), best_of_all(objects, aim, 0, true));
        most = std::max(most, found.rounds);
    }
    // Two by value, then 64 bits of which each round takes 3.
    EXPECT_LE(most, 2 + 22);
}

TEST(NormSearch, takes_both_zeros_for_one_place) {
    EXPECT_EQ(key_of(0.0), key_of(-0.0));
    EXPECT_LT(key_of(-1.0), key_of(-DBL_MIN));
    EXPECT_LT(key_of(-5e-324), key_of(0.0));
    EXPECT_LT(key_of(0.0), key_of(5e-324));
    EXPECT_LT(key_of(1.0), key_of(DBL_MAX));
}

TEST(NormSearch, divides_a_node_without_weight_by_number) {
    Objects objects;
    for (int i = 0; i < 10; ++i) {
        objects.coordinates.push_back(i * i);
        objects.loads.push_back({0, 0, 0, 0, 1});
    }
    const Found found = search_for(objects, aim_for(objects, 2, 2, 0.3), 0, 1, 8);
    EXPECT_EQ(found.search.below()[most_weights], 3);
}

TEST(Norms, are_those_of_the_loads_over_their_shares) {
    // Shares of a half double the loads of both sides.
    const Aim sum = aim_of(1, {0.1, 0.01}, {0.5, 0.5, 0.5, 0.5}, {10, 100, 0, 0, 5});
    EXPECT_DOUBLE_EQ(norm_below(sum, {3, 20, 0, 0, 1}), 2 * (0.3 + 0.2));
    EXPECT_DOUBLE_EQ(norm_above(sum, {3, 20, 0, 0, 1}), 2 * (0.7 + 0.8));
    Aim other = sum;
    other.norm = 2;
    EXPECT_DOUBLE_EQ(norm_below(other, {3, 20, 0, 0, 1}), 2 * std::sqrt(0.09 + 0.04));
    other.norm = 3;
    EXPECT_DOUBLE_EQ(norm_above(other, {3, 20, 0, 0, 1}), 1.6);
    EXPECT_DOUBLE_EQ(quality(other, {8, 20, 0, 0, 1}), 1.6);
}

TEST(OnePlace, is_divided_where_the_norms_are_nearest) {
    std::mt19937 random(4);
    for (int round = 0; round < 200; ++round) {
        Objects objects;
        for (int i = 0; i < 40; ++i) {
            objects.coordinates.push_back(2);
            objects.loads.push_back(random_load(random, 2));
        }
        const Aim aim = aim_for(objects, 2 + round % 2, 2, 0.5);
        const Points points = objects.points();
        NormObjects mine(points, objects.loads);
        const Found found = search_for(objects, aim, 0, 1, 8);
        ASSERT_TRUE(found.search.meets_one_place());
        const auto place = mine.listed(mine.all(), 0, mine.list(mine.all(), 0));
        const std::size_t middle =
            mine.divide(mine.all(), found.search.cut(), place, found.search.before(), aim);
        Load below{};
        double best = larger_norm(aim, below);
        for (const Load& load : objects.loads) {
            below = below + load;
            best = std::min(best, larger_norm(aim, below));
        }
        EXPECT_EQ(larger_norm(aim, mine.sum(NormObjects::Range{0, middle})), best);
    }
}

}  // namespace
}  // namespace rrcb::zoltan
