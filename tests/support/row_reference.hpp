// Finished searches of rows of points, against a sort of all points in one place.
#pragma once

#include "row_cases.hpp"
#include "row_searches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace rrcb::test {

/// Compares a finished search with all points in one place.
class RowReference {
  public:
    RowReference(const RowCase& one, const RowSearches& ranks) : case_(one), ranks_(ranks) {
        for (std::size_t rank = 0; rank < one.rows.size(); ++rank) {
            const std::vector<Part> parts = ranks.passes(rank).parts();
            auto part = parts.begin();
            for (const Row& row : one.rows[rank])
                for (LocalIndex k = 0; k < row.count; ++k)
                    points_.push_back({row.position(k), weight_of(row), *part++});
        }
    }

    /// Every point has the part of its position, and every cut divides as well as any could.
    void expect_exact() const {
        for_each_node([&](const Descent& at, const std::vector<Point>& all) {
            const Node node = node_of(at, all, case_.divides_coincident);
            if (!node.is_divided || (case_.divides_coincident && node.least.first > 0)) return;
            // Of two cuts that are nearly as good the lower one is taken if points weigh the same.
            const long double nearly = case_.has_equal_weights ? 0x1p-11L / node.all : 0;
            const long double of_side = std::min(node.share, 1 - node.share);
            EXPECT_LE(node.loss.second, node.least.second + round_off + nearly / of_side) << case_;
            if (case_.divides_coincident) return;
            EXPECT_EQ(node.loss.first, node.least.first) << case_;
            if (node.is_unique) expect_centred(node);
        });
    }

    /// Every cut leaves its sides to the tolerance, or divides as well as any could.
    void expect_tolerance(const std::vector<double>& part_weights) const {
        for_each_node([&](const Descent& at, const std::vector<Point>& all) {
            const Node node = node_of(at, all, ranks_.cuts().at(at.node).divides != 0);
            if (!node.is_divided) return;
            const auto is_good = [&](const Descent& side, std::int64_t weight) {
                return weight <= most_of(side, node) || is_within(side, part_weights);
            };
            const bool is_kept =
                is_good(at.lower(), node.below) && is_good(at.upper(), node.all - node.below);
            const bool is_best = node.loss.second <= node.least.second + round_off;
            EXPECT_TRUE(is_kept || is_best)
                << case_ << ", node " << at.node << " of " << at.num_parts << " parts";
        });
    }

    /// Returns true if equal parts are empty although there are points for all.
    bool leaves_parts_empty(const std::vector<double>& part_weights) const {
        return std::ranges::min(case_.part_sizes) == std::ranges::max(case_.part_sizes) &&
               points_.size() >= part_weights.size() &&
               std::ranges::find(part_weights, 0.0) != part_weights.end();
    }

  private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr long double round_off = 1e-11L;

    /// A point and the part that a search gave it.
    struct Point {
        Vector position;
        std::int64_t weight;
        Part part;
    };

    /// Parts that a cut leaves empty although there are points for all, and its excess: the weight
    /// of the side that has more of its own share, over that share.
    using Loss = std::pair<std::int64_t, long double>;

    /// A cut and its sides, and what the best one would leave.
    struct Node {
        Descent at{};
        Cut cut{};
        std::vector<Point> sorted{};
        std::int64_t all = 0;
        std::int64_t below = 0;
        long double share = 0;
        Loss loss{};
        Loss least{};
        std::size_t best = 0;  ///< points below the best cut
        bool is_divided = false;
        bool is_unique = true;  ///< no other cut is as good
    };

    std::int64_t weight_of(const Row& row) const {
        return case_.has_equal_weights ? 1 : static_cast<std::int64_t>(row.weight);
    }

    long double size_of(const Descent& at) const {
        return std::accumulate(case_.part_sizes.begin() + at.first_part,
                               case_.part_sizes.begin() + at.first_part + at.num_parts, 0.0L);
    }

    static std::int64_t sum_of(std::span<const Point> points) {
        return std::accumulate(points.begin(), points.end(), std::int64_t{0},
                               [](std::int64_t sum, const Point& x) { return sum + x.weight; });
    }

    /// The numbers by which positions are ordered across an axis.
    Vector key_of(const Vector& x, int axis) const {
        Vector key{x[static_cast<std::size_t>(axis)], 0, 0};
        std::size_t next = 1;
        for (std::size_t a = 0; a < static_cast<std::size_t>(case_.dimension); ++a)
            if (static_cast<int>(a) != axis && !case_.plain_cuts) key[next++] = x[a];
        return key;
    }

    /// Visits all nodes that have points, and checks the sides of these.
    template <class Visit>
    void for_each_node(Visit&& visit) const {
        const auto descend = [&](const auto& self, const Descent& at,
                                 const std::vector<Point>& all) -> void {
            if (all.empty()) return;
            if (at.is_part()) {
                for (const Point& one : all) ASSERT_EQ(one.part, at.first_part) << case_;
                return;
            }
            ASSERT_TRUE(ranks_.cuts().contains(at.node)) << case_;
            const Cut& cut = ranks_.cuts().at(at.node);
            std::vector<Point> sides[2];
            for (const Point& one : all) {
                const bool is_above = at.is_above(one.part);
                const auto key = key_of(one.position, cut.axis);
                const auto at_cut = key_of(cut.at, cut.axis);
                const bool is_free = cut.divides != 0 && key == at_cut;
                ASSERT_TRUE(is_free || is_above == (key >= at_cut)) << case_;
                sides[is_above ? 1 : 0].push_back(one);
            }
            visit(at, all);
            self(self, at.lower(), sides[0]);
            self(self, at.upper(), sides[1]);
        };
        descend(descend, {0, 0, case_.num_parts, case_.shape}, points_);
    }

    /// `divides`: the best cut may divide coincident points.
    Node node_of(const Descent& at, const std::vector<Point>& all, bool divides) const {
        Node node{.at = at, .cut = ranks_.cuts().at(at.node), .sorted = all, .all = sum_of(all)};
        const long double size = size_of(at);
        node.share = size > 0 ? size_of(at.lower()) / size : 0;
        std::size_t num_below = 0;
        for (const Point& one : all) {
            if (at.is_above(one.part)) continue;
            ++num_below;
            node.below += one.weight;
        }
        const bool has_sides = node.share > 0 && node.share < 1;
        if (!has_sides && size > 0) {
            EXPECT_EQ(node.below, node.share > 0 ? node.all : 0) << "a side of size 0, " << case_;
        }
        node.is_divided = has_sides && node.all > 0;
        if (!node.is_divided) return node;
        node.loss = loss_of(at, node, num_below, node.below);
        find_best(at, divides, node);
        return node;
    }

    /// Tries all cuts. Coincident points are divided by their weight only.
    void find_best(const Descent& at, bool divides, Node& node) const {
        const auto key = [&](const Point& one) { return key_of(one.position, node.cut.axis); };
        std::ranges::stable_sort(node.sorted, {}, key);
        node.least = loss_of(at, node, 0, 0);
        std::int64_t below = 0;
        for (std::size_t k = 1; k <= node.sorted.size(); ++k) {
            below += node.sorted[k - 1].weight;
            if (!divides && k < node.sorted.size() && are_coincident(node, k)) continue;
            const Loss loss = loss_of(at, node, k, below);
            if (loss.first == node.least.first &&
                std::abs(loss.second - node.least.second) <= round_off)
                node.is_unique = false;
            if (divides ? loss.second >= node.least.second : loss >= node.least) continue;
            node.is_unique =
                loss.first < node.least.first || loss.second < node.least.second - round_off;
            node.least = loss;
            node.best = k;
        }
    }

    Loss loss_of(const Descent& at, const Node& node, std::size_t count, std::int64_t below) const {
        const auto part = static_cast<long double>(below) / static_cast<long double>(node.all);
        const auto lacking = [](const Descent& side, std::size_t points) {
            return std::max<std::int64_t>(0, side.num_parts - static_cast<std::int64_t>(points));
        };
        const auto sizes = std::span(case_.part_sizes)
                               .subspan(static_cast<std::size_t>(at.first_part),
                                        static_cast<std::size_t>(at.num_parts));
        const bool fills = std::ranges::min(sizes) == std::ranges::max(sizes) &&
                           node.sorted.size() >= sizes.size();
        return {fills ? lacking(at.lower(), count) + lacking(at.upper(), node.sorted.size() - count)
                      : 0,
                std::max(part / node.share, (1 - part) / (1 - node.share))};
    }

    /// The cut is in the middle between the nearest points on both sides, along the first axis on
    /// which these differ.
    void expect_centred(const Node& node) const {
        if (node.best == 0 || node.best == node.sorted.size()) return;
        const Vector& below = node.sorted[node.best - 1].position;
        const Vector& above = node.sorted[node.best].position;
        Vector expected{-infinity, -infinity, -infinity};
        for (int k = 0; k < case_.dimension; ++k) {
            const auto axis = static_cast<std::size_t>(k == 0               ? node.cut.axis
                                                       : k <= node.cut.axis ? k - 1
                                                                            : k);
            expected[axis] = above[axis];
            if (below[axis] == above[axis]) continue;
            const double middle = below[axis] / 2 + above[axis] / 2;
            if (middle > below[axis]) expected[axis] = middle;
            break;
        }
        EXPECT_EQ(node.cut.at, expected) << case_;
    }

    long double ideal_of(const Descent& at) const {
        const Descent top{0, 0, case_.num_parts, case_.shape};
        return size_of(at) / size_of(top) * static_cast<long double>(sum_of(points_));
    }

    bool is_within(const Descent& at, const std::vector<double>& part_weights) const {
        for (Part part = at.first_part; part < at.first_part + at.num_parts; ++part)
            if (part_weights[static_cast<std::size_t>(part)] >
                case_.tolerance * ideal_of({0, part, 1}) * (1 + round_off))
                return false;
        return true;
    }

    /// Returns the tolerance that whole points of equal weight leave to the smallest part.
    long double tolerance_of(const Descent& at) const {
        if (!case_.has_equal_weights) return case_.tolerance;
        long double smallest = infinity;
        for (Part part = at.first_part; part < at.first_part + at.num_parts; ++part)
            if (const long double ideal = ideal_of({0, part, 1}); ideal > 0)
                smallest = std::min(smallest, ideal);
        return std::max(1.0L, std::floor(case_.tolerance * smallest * (1 + round_off)) / smallest);
    }

    static int levels_of(const Descent& at) {
        return at.is_part() ? 0 : 1 + std::max(levels_of(at.lower()), levels_of(at.upper()));
    }

    /// Returns the most that a side of a node may weigh: so much that each level below has the same
    /// factor left of the tolerance, or half of the excess or more, by the levels above.
    long double most_of(const Descent& side, const Node& node) const {
        const long double ideal = ideal_of(side);
        const long double tolerance = tolerance_of(node.at);
        const long double growth =
            std::pow(tolerance * ideal_of(node.at) / node.all, 1.0L / levels_of(node.at));
        const long double left =
            levels_of(side) / (2.0L * levels_of({0, 0, case_.num_parts, case_.shape}));
        const long double share = size_of(side) / size_of(node.at);
        return (1 + round_off) * std::max(share * node.all * growth,
                                          ideal * (1 + (tolerance_of(side) - 1) * (1 - left)));
    }

    bool are_coincident(const Node& node, std::size_t k) const {
        return key_of(node.sorted[k - 1].position, node.cut.axis) ==
               key_of(node.sorted[k].position, node.cut.axis);
    }

    const RowCase& case_;
    const RowSearches& ranks_;
    std::vector<Point> points_;
};

}  // namespace rrcb::test
