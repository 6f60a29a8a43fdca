// What holds for any call in which many ranks make the parts, see ExpertOptions::max_root_parts.
#pragma once

#include "../support/ranks.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/quality.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace rrcb::test {

/// Every point is where the cuts put it.
inline void expect_parts_of_cuts(const Points& points, const Balance& result) {
    ASSERT_EQ(std::ssize(result.cuts.tree) + 1, result.cuts.num_parts);
    for (LocalIndex i = 0; i < points.count; ++i)
        ASSERT_EQ(result.parts[i], part_of(result.cuts, points.position(i)));
}

/// All ranks have the same cuts. Collective.
inline void expect_same_cuts_on_all_ranks(const Cuts& cuts) {
    std::vector<double> mine;
    for (const Cut& cut : cuts.tree) {
        mine.insert(mine.end(), {1.0 * cut.axis, 1.0 * cut.divides});
        mine.insert(mine.end(), cut.at.begin(), cut.at.end());
    }
    std::vector<double> of_root = mine;
    MPI_Bcast(of_root.data(), static_cast<int>(of_root.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
    EXPECT_EQ(mine, of_root);
}

/// Checks all that holds where many ranks make the parts; returns the weights of these. Collective.
inline std::vector<double> expect_consistent(const Points& points, const Balance& result) {
    expect_parts_of_cuts(points, result);
    expect_same_cuts_on_all_ranks(result.cuts);
    Points counted = points;
    if (result.report.details.all_weights_zero) counted.weights = {};
    const std::vector<double> weights = part_weights(counted, result, MPI_COMM_WORLD);
    EXPECT_TRUE(result.report.part_weights == weights || result.report.details.num_points == 0);
    return weights;
}

}  // namespace rrcb::test
