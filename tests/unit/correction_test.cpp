// Corrections of all cuts at once, on the points of one rank: what is left open, what is counted
// and where the cuts go, against looking up every point.
#include "../support/clouds.hpp"
#include "passes/collected.hpp"
#include "search/slab_counts.hpp"

#include <rrcb/paper.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace rrcb {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Points with cuts that divide them badly, and all that a correction works on.
struct Example {
    int dimension;
    std::vector<double> coordinates;
    std::vector<double> weights{};
    std::vector<double> sizes;
    double tolerance;
    Cuts cuts{};
    std::vector<Bracket> brackets{};
    std::vector<Slab> slabs{};

    Points points() const { return interleaved_points(coordinates, dimension, weights); }

    /// Cuts the points exactly, and moves each cut by up to `error` of its node's weight.
    void cut(double error, unsigned seed) {
        Bisection exact =
            bisect_points(mass_points(points()), dimension, static_cast<int>(sizes.size()), sizes);
        cuts = std::move(exact.cuts);
        slabs.resize(cuts.tree.size());
        brackets.resize(cuts.tree.size());
        std::mt19937_64 engine(seed);
        std::vector<std::size_t> all(points().count);
        std::iota(all.begin(), all.end(), std::size_t{0});
        displace(root_of(cuts), all, 0, error, engine);
    }

    void displace(const Descent& at, std::vector<std::size_t> members, int depth, double error,
                  std::mt19937_64& engine) {
        if (at.is_part()) return;
        Cut& cut = cuts.tree[at.node];
        const auto axis = static_cast<int>(cut.axis);
        std::ranges::sort(members, {}, [&](std::size_t i) { return points().coordinate(i, axis); });
        const double value = cut.at[static_cast<std::size_t>(axis)];
        const auto n = static_cast<double>(members.size());
        const auto below = static_cast<double>(std::ranges::count_if(
            members, [&](std::size_t i) { return points().coordinate(i, axis) < value; }));
        const auto coordinate = [&](double share) {
            const auto k = std::clamp(below + share * n, 0.0, n - 1);
            return points().coordinate(members[static_cast<std::size_t>(k)], axis);
        };
        if (members.empty() || !std::isfinite(value)) return;
        const double moved = test::uniform(engine, -error, error);
        const double margin = std::min(0.25, 0.01 * std::exp2(depth / 2.0));
        brackets[at.node] = {coordinate(moved - margin),
                             std::nextafter(coordinate(moved + margin), infinity)};
        cut = plane(axis, coordinate(moved));
        const auto middle = std::partition(members.begin(), members.end(), [&](std::size_t i) {
            return !is_above(cut, points().position(i), dimension);
        });
        const std::vector<std::size_t> upper(middle, members.end());
        members.erase(middle, members.end());
        displace(at.lower(), std::move(members), depth + 1, error, engine);
        displace(at.upper(), upper, depth + 1, error, engine);
    }

    std::vector<Part> parts() const {
        std::vector<Part> parts;
        for (LocalIndex i = 0; i < points().count; ++i)
            parts.push_back(part_of(cuts, points().position(i)));
        return parts;
    }

    std::vector<double> part_weights() const {
        std::vector<double> sums(sizes.size());
        const std::vector<Part> all = parts();
        for (std::size_t i = 0; i < all.size(); ++i)
            sums[static_cast<std::size_t>(all[i])] += points().weight(i);
        return sums;
    }

    double imbalance() const { return rrcb::imbalance(part_weights(), sizes); }

    TargetRule rule() const {
        const std::vector<double> sums = part_weights();
        TargetRule rule;
        rule.part_sizes = sizes;
        rule.tolerance = tolerance;
        rule.counted_weight = std::accumulate(sums.begin(), sums.end(), 0.0);
        rule.weight_per_size =
            rule.counted_weight / std::accumulate(sizes.begin(), sizes.end(), 0.0);
        rule.heaviest = weights.empty() ? 1 : std::ranges::max(weights);
        rule.common_weight = weights.empty() ? 1 : 0;
        return rule;
    }

    SlabTotals lay() { return lay_slabs(rule(), cuts, brackets, part_weights(), slabs); }

    /// The points in the slabs; `parts` are those by the cuts before, those of the others then.
    Collected open_points(std::vector<Part>& parts) const {
        std::vector<Bracket> intervals;
        for (const Slab& slab : slabs)
            intervals.push_back(
                {slab.lower, std::max(slab.upper, std::nextafter(slab.lower, infinity))});
        Collected open;
        collect(points(), cuts, intervals, true, parts, open);
        return open;
    }

    /// The cuts corrected once.
    Cuts corrected(const SlabTotals& totals) const {
        const std::vector<Part> before = parts();
        std::vector<Part> settled = before;
        const Collected open = open_points(settled);
        std::vector<Part> of_open;
        for (const LocalIndex i : open.original) of_open.push_back(before[i]);
        std::vector<double> counts(totals.counts);
        std::vector<double> values(totals.moving);
        std::vector<double> sums = part_weights();
        count_in_slabs(open, of_open, cuts, slabs, counts);
        correct(rule(), cuts, slabs, sums, counts, values);
        Cuts moved = cuts;
        for (std::size_t k = 0; k < slabs.size(); ++k)
            if (slabs[k].moves()) moved.tree[k] = plane(cuts.tree[k].axis, values[slabs[k].number]);
        return moved;
    }
};

/// Clusters, whose cuts have gaps and crowds beside them; or a lattice, with ties on every cut.
Example example(int dimension, std::size_t num_parts, unsigned seed, bool is_lattice = false) {
    std::mt19937_64 engine(seed);
    std::vector<double> centres = test::uniform_cloud(6, dimension, seed + 100);
    Example made{dimension, {}, {}, std::vector<double>(num_parts, 1.0), 1.02};
    for (std::size_t i = 0; i < 20000; ++i) {
        const std::size_t cluster = engine() % 6;
        for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a) {
            const double spread = test::uniform(engine) + test::uniform(engine) - 1;
            const double x =
                centres[cluster * static_cast<std::size_t>(dimension) + a] + 0.2 * spread;
            made.coordinates.push_back(is_lattice ? std::round(64 * x) : x);
        }
        if (seed % 2 == 0) made.weights.push_back(std::exp2(test::uniform(engine, -12, 0)));
    }
    if (seed % 3 == 0) made.sizes[num_parts / 2] = 2;
    return made;
}

TEST(Slabs, of_one_cut_hold_what_it_is_off_by_and_a_good_cut_has_none) {
    Example line{1, {}, {}, {1, 1}, 1.02};
    for (int i = 0; i < 1000; ++i) line.coordinates.push_back(i);
    line.cuts = {1, 2, {plane(0, 530)}};
    line.brackets = {{520, 540}};  // a hundredth to both sides
    line.slabs.resize(1);
    EXPECT_EQ(line.lay().moving, 1u);
    // 30 of 1000 too many below, three times that, and a quarter of the bracket of 10 to each side.
    EXPECT_NEAR(line.slabs[0].lower, 437.5, 1e-9);
    EXPECT_NEAR(line.slabs[0].upper, 532.5, 1e-9);
    line.cuts.tree[0] = plane(0, 508);
    EXPECT_EQ(line.lay().moving, 0u) << "508 of 500 are within 2 %";
    line.cuts.tree[0] = plane(0, 900);
    EXPECT_EQ(line.lay().moving, 0u) << "too far off";
}

TEST(Slabs, leave_a_side_alone_that_is_even_where_no_cut_above_moves) {
    Example line{1, {}, {}, {1, 1, 1, 1}, 1.02};
    for (int i = 0; i < 4000; ++i) line.coordinates.push_back(i);
    line.cuts = {1, 4, {plane(0, 2000), plane(0, 1000), plane(0, 3040)}};
    line.brackets = {{1960, 2040}, {960, 1040}, {3000, 3080}};
    line.slabs.resize(3);
    EXPECT_EQ(line.lay().moving, 1u);
    EXPECT_EQ(line.slabs[1].lower, line.slabs[1].upper);
    EXPECT_TRUE(line.slabs[2].moves());
    line.cuts.tree[0] = plane(0, 2060);
    EXPECT_EQ(line.lay().moving, 3u) << "what the first cut gives back comes to both sides";
}

TEST(Slabs, have_bins_that_meet_and_hold_what_is_counted_in_them) {
    std::mt19937_64 engine(3);
    for (const Slab slab : {Slab{-1, 3}, Slab{0, 5e-324}, Slab{1, 1 + 1e-15}, Slab{-8e307, 8e307}})
        for (int i = 0; i < 1000; ++i) {
            const double cut = std::lerp(slab.lower, slab.upper, test::uniform(engine));
            const double x = std::lerp(slab.lower, slab.upper, test::uniform(engine));
            const bool above = x >= cut;
            const int bin = bin_of(slab, cut, above, x);
            const double inner = place_in_bin(slab, cut, above, bin, 0);
            const double outer = place_in_bin(slab, cut, above, bin, 1);
            const double rounding = 4e-16 * std::max({1e-300, std::abs(inner), std::abs(outer)});
            EXPECT_GE(x, std::min(inner, outer) - rounding);
            EXPECT_LE(x, std::max(inner, outer) + rounding);
            if (bin > 0) {
                EXPECT_EQ(outer, place_in_bin(slab, cut, above, bin - 1, 0));
            }
        }
}

TEST(Collected, are_all_whose_part_may_change_and_the_others_are_weighed) {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const int dimension = 1 + static_cast<int>(seed % 3);
        Example made = example(dimension, 2 + seed % 7, seed, seed > 6);
        made.cut(0.02, seed);
        made.lay();
        const std::vector<Part> parts = made.parts();
        std::vector<Part> settled = parts;
        const Collected open = made.open_points(settled);
        std::vector<bool> is_open(parts.size());
        for (std::size_t k = 0; k < open.original.size(); ++k) {
            const LocalIndex i = open.original[k];
            is_open[i] = true;
            EXPECT_EQ(open.position(k), made.points().position(i));
            EXPECT_EQ(open.weight(k), made.points().weight(i));
            EXPECT_EQ(settled[i], no_part);
        }
        EXPECT_LT(open.original.size(), 3 * parts.size() / 4) << seed;
        std::vector<double> decided(made.sizes.size());
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (!is_open[i]) {
                EXPECT_EQ(settled[i], parts[i]);
                decided[static_cast<std::size_t>(parts[i])] += made.points().weight(i);
            }
        for (std::size_t p = 0; p < decided.size(); ++p)
            EXPECT_NEAR(open.settled.weights[p], decided[p], 1e-12 * decided[p]);
        std::mt19937_64 engine(seed);
        for (int trial = 0; trial < 20; ++trial) {
            Example moved = made;
            for (std::size_t k = 0; k < moved.slabs.size(); ++k) {
                const Slab& slab = moved.slabs[k];
                const double share = trial == 0 ? 0 : trial == 1 ? 1 : test::uniform(engine);
                if (slab.moves())
                    moved.cuts.tree[k] =
                        plane(moved.cuts.tree[k].axis, std::lerp(slab.lower, slab.upper, share));
            }
            const std::vector<Part> after = moved.parts();
            for (std::size_t i = 0; i < after.size(); ++i)
                ASSERT_TRUE(is_open[i] || after[i] == parts[i]);
        }
    }
}

TEST(Collected, get_the_parts_of_cuts_that_have_moved) {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        Example made = example(2, 5, seed, seed > 3);
        made.cut(0.02, seed);
        const SlabTotals totals = made.lay();
        std::vector<Part> parts = made.parts();
        const Collected open = made.open_points(parts);
        std::vector<Part> of_open;
        made.cuts = made.corrected(totals);
        std::vector<double> weights(made.sizes.size());
        assign_collected(made.cuts, open, of_open, weights);
        for (LocalIndex k = 0; k < open.count(); ++k) parts[open.original[k]] = of_open[k];
        EXPECT_EQ(parts, made.parts());
        const std::vector<double> expected = made.part_weights();
        for (std::size_t p = 0; p < weights.size(); ++p)
            EXPECT_NEAR(weights[p], expected[p], 1e-12 * expected[p]);
    }
}

TEST(Correction, of_one_cut_finds_its_place_to_within_a_bin) {
    Example line{1, {}, {}, {3, 2}, 1.001};
    for (int i = 0; i < 100000; ++i) line.coordinates.push_back(i);
    for (const double cut : {57000.0, 59400.0, 60500.0, 63000.0}) {
        line.cuts = {1, 2, {plane(0, cut)}};
        line.brackets = {{cut - 1000, cut + 1000}};
        line.slabs.resize(1);
        const Cuts corrected = line.corrected(line.lay());
        EXPECT_NEAR(corrected.tree[0].at[0], 60000, 2) << "uniform inside each bin";
    }
}

TEST(Correction, tells_cuts_below_what_a_cut_above_brings_them) {
    // All of the thousand points that the first cut has to move lie in the upper half of what is
    // below it, and in the lower half of what is above.
    Example square{2, {}, {}, {1, 1, 1, 1}, 1.01};
    const auto add = [&](int count, double x, double lower, double upper) {
        for (int i = 0; i < count; ++i) {
            square.coordinates.push_back(x + 1e-6 * i);
            square.coordinates.push_back(lower + (upper - lower) * (i * 7919 % count) / count);
        }
    };
    add(9000, 0, 0, 100);
    add(1000, 0.5, 80, 100);
    add(10000, 1, 0, 100);
    square.cuts = {2, 4, {plane(0, 0.5), plane(1, 50), plane(1, 50)}};
    square.brackets = {{0.4998, 0.5002}, {48, 52}, {48, 52}};
    square.slabs.resize(3);
    square.coordinates.push_back(0.501);
    square.coordinates.push_back(90);
    EXPECT_GT(square.imbalance(), 1.05);
    square.cuts = square.corrected(square.lay());
    EXPECT_LT(square.imbalance(), 1.01);
}

TEST(Correction, brings_most_clouds_within_the_tolerance_at_once_and_the_rest_nearer) {
    int num_within = 0;
    int num_corrected = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
        Example made = example(1 + static_cast<int>(seed % 3), 2 + seed % 9, seed);
        made.cut(0.03, seed);
        const double before = made.imbalance();
        const SlabTotals totals = made.lay();
        if (totals.moving == 0) continue;
        ++num_corrected;
        made.cuts = made.corrected(totals);
        EXPECT_LT(made.imbalance(), std::max(made.tolerance, 1 + (before - 1) / 2)) << seed;
        num_within += made.imbalance() <= made.tolerance ? 1 : 0;
    }
    EXPECT_GE(num_corrected, 25);
    EXPECT_GE(num_within, num_corrected * 9 / 10);
}

}  // namespace
}  // namespace rrcb
