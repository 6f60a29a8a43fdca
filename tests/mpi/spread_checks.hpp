// What holds for any call in which many ranks make the parts, see Tuning::central_parts.
#pragma once

#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rrcb::test {

/// Node of a tree, as the documentation of Cuts describes it.
struct Node {
    int number;
    int first_part;
    int num_parts;

    Node lower() const { return {number + 1, first_part, num_parts / 2}; }
    Node upper() const {
        const int below = num_parts / 2;
        return {number + below, first_part + below, num_parts - below};
    }
};

/// The cut of a node, or null where this rank does not know it.
inline const Cut* find(const Cuts& cuts, const Node& node) {
    const auto at = std::ranges::lower_bound(cuts.nodes, node.number);
    if (at == cuts.nodes.end() || *at != node.number) return nullptr;
    return &cuts.tree[static_cast<std::size_t>(at - cuts.nodes.begin())];
}

/// Every point is where the cuts that its rank knows put it.
inline void expect_parts_of_cuts(const Points& points, const Balance& result) {
    const Cuts& cuts = result.cuts;
    ASSERT_EQ(cuts.nodes.size(), cuts.tree.size());
    ASSERT_FALSE(is_whole(cuts));
    ASSERT_TRUE(std::ranges::is_sorted(cuts.nodes));
    for (LocalIndex i = 0; i < points.count; ++i) {
        Node at{0, 0, cuts.num_parts};
        while (at.num_parts > 1) {
            const Cut* cut = find(cuts, at);
            ASSERT_NE(cut, nullptr) << "node " << at.number;
            at = is_above(*cut, points.position(i), points.dimension) ? at.upper() : at.lower();
        }
        ASSERT_EQ(result.parts[i], at.first_part);
    }
}

/// The cuts on the way to the parts of this rank are known.
inline void expect_own_paths(const Cuts& cuts) {
    for (int part = 0; part < cuts.num_parts; ++part) {
        const RankRange ranks = ranks_of_part(part, cuts.num_parts, num_ranks());
        if (rank() < ranks.first_rank || rank() >= ranks.first_rank + ranks.count) continue;
        Node at{0, 0, cuts.num_parts};
        while (at.num_parts > 1) {
            EXPECT_NE(find(cuts, at), nullptr);
            at = part >= at.upper().first_part ? at.upper() : at.lower();
        }
    }
}

/// Ranks that know a cut know the same one. Collective.
inline void expect_same_cuts_on_all_ranks(const Cuts& cuts) {
    std::vector<double> mine(static_cast<std::size_t>(5 * (cuts.num_parts - 1)), -HUGE_VAL);
    std::vector<double> most(mine.size());
    std::vector<double> least(mine.size(), HUGE_VAL);
    for (std::size_t k = 0; k < cuts.tree.size(); ++k) {
        const auto at = static_cast<std::size_t>(5 * cuts.nodes[k]);
        const Cut& cut = cuts.tree[k];
        const double values[] = {1.0, 1.0 * cut.axis, cut.at[0], cut.at[1], cut.at[2]};
        std::ranges::copy(values, mine.begin() + static_cast<std::ptrdiff_t>(at));
        std::ranges::copy(values, least.begin() + static_cast<std::ptrdiff_t>(at));
    }
    const int length = static_cast<int>(mine.size());
    MPI_Allreduce(mine.data(), most.data(), length, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, least.data(), length, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    for (std::size_t k = 0; k < most.size(); k += 5) {
        ASSERT_EQ(most[k], 1) << "node " << k / 5 << " is known to nobody";
        for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(most[k + i], least[k + i]);
    }
}

/// Checks all that holds where many ranks make the parts; returns the weights of these. Collective.
inline std::vector<double> expect_consistent(const Points& points, const Balance& result) {
    expect_parts_of_cuts(points, result);
    expect_own_paths(result.cuts);
    expect_same_cuts_on_all_ranks(result.cuts);
    EXPECT_TRUE(result.report.part_weights.empty());
    Points counted = points;
    if (result.report.details.all_weights_zero) counted.weights = {};
    return part_weights(counted, result, MPI_COMM_WORLD);
}

}  // namespace rrcb::test
