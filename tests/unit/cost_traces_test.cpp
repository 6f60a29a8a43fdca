// Traces of a moving cluster with true costs: what learned weights cost beyond counting, in true
// time.
#include "cost_traces.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace rrcb::test {
namespace {

double points(const RankSums& s) {
    return s.points;
}
double columns(const RankSums& s) {
    return s.points + 2 * s.cells + 0.5 * s.shared;
}
double hidden(const RankSums& s) {
    return s.points + 2 * s.hidden;
}
double band(const RankSums& s) {
    return s.points + 2 * s.band;
}
double clustered(const RankSums& s) {
    return s.points + 2 * s.clustered;
}
double spread(const RankSums& s) {
    return 3 * s.points - 2 * s.clustered;
}
double against(const RankSums& s) {
    return s.points + 300 * s.points / (1 + s.cells);
}
double pairs(const RankSums& s) {
    return s.points * s.points / (1 + s.cells);
}
double constant(const RankSums&) {
    return 1;
}
double unrelated(const RankSums& s) {
    return 1 + 0.3 * std::sin(7.0 * s.rank + 0.1 * s.step);
}
double changing(const RankSums& s) {
    return s.step < 150 ? columns(s) : points(s);
}
double changing_twice(const RankSums& s) {
    return s.step < 280 ? points(s) + columns(s) - changing(s) : points(s);
}
double growing(const RankSums& s) {
    return columns(s) * (1 + 0.01 * s.step);
}
double every_fifth(const RankSums& s) {
    return points(s) + (s.step % 5 == 0 ? 10 * s.cells : 0);
}
double slow_points(const RankSums& s) {
    return points(s) * (s.rank == 1 ? 1.5 : 1);
}
double slow_columns(const RankSums& s) {
    return columns(s) * (s.rank == 1 ? 1.5 : 1);
}

/// A clock whose tick is as long as a step.
double ticks(double seconds, const RankSums& s) {
    const double phase = 0.618 * (s.rank + 8 * s.step);
    return 600 * std::floor(seconds / 600 + phase - std::floor(phase));
}
double stalls(double seconds, const RankSums& s) {
    return (s.rank + 8 * s.step) % 97 == 13 ? 20 * seconds : seconds;
}

std::vector<Trace> traces() {
    std::vector<Trace> all;
    for (const double noise : {0.0, 0.03, 0.1}) {
        const std::string with = ", noise " + std::to_string(static_cast<int>(100 * noise)) + " %";
        all.push_back({"columns" + with, columns, noise});
        all.push_back({"points" + with, points, noise});
        all.push_back({"costs unknown to the columns" + with, hidden, noise});
        all.push_back({"slow core" + with, slow_columns, noise});
    }
    all.push_back({"columns, fast cluster", columns, 0.03, 8, 20, 3, 400});
    all.push_back({"columns, slow cluster", columns, 0.03, 8, 20, 3, 3000});
    all.push_back({"columns, 2 ranks", columns, 0.03, 2});
    all.push_back({"columns, 4 ranks", columns, 0.03, 4});
    all.push_back({"columns, 16 ranks", columns, 0.03, 16});
    all.push_back({"columns, a rebalance each step", columns, 0.03, 8, 1});
    all.push_back({"columns, a rebalance in 100 steps", columns, 0.03, 8, 100});
    all.push_back({"one rank", columns, 0.03, 1});
    all.push_back({"one column", columns, 0.03, 8, 20, 1});
    all.push_back({"collinear columns and one of zeros", columns, 0.03, 8, 20, 7});
    all.push_back({"collinear columns, points", points, 0.03, 4, 20, 7});
    all.push_back({"unknown to the columns, 2 ranks", hidden, 0.03, 2});
    all.push_back({"unknown to the columns, 4 ranks", hidden, 0.03, 4});
    for (const int ranks : {2, 4, 8}) {
        const std::string on = ", " + std::to_string(ranks) + " ranks";
        all.push_back({"dear band" + on, band, 0.03, ranks});
        all.push_back({"dear cluster" + on, clustered, 0.03, ranks});
        all.push_back({"cheap cluster" + on, spread, 0.03, ranks});
        all.push_back({"dear band, fast" + on, band, 0.03, ranks, 20, 3, 400});
        all.push_back({"dear region, fast" + on, hidden, 0.03, ranks, 20, 3, 400});
    }
    all.push_back({"the fewer cells the dearer", against});
    all.push_back({"the fewer cells the dearer, 4 ranks", against, 0.03, 4});
    all.push_back({"pairs in cells", pairs});
    all.push_back({"the same on all ranks", constant});
    all.push_back({"without relation", unrelated});
    all.push_back({"slow core, points", slow_points});
    all.push_back({"slow core, points, 4 ranks", slow_points, 0.03, 4});
    all.push_back({"change to points", changing});
    all.push_back({"change to columns and back", changing_twice});
    all.push_back({"growing", growing});
    all.push_back({"cells in every fifth step", every_fifth});
    all.push_back({"clock of a step, columns", columns, 0.03, 8, 20, 3, 1000, ticks});
    all.push_back({"clock of a step, points", points, 0.03, 8, 20, 3, 1000, ticks});
    all.push_back({"stalls, columns", columns, 0.03, 8, 20, 3, 1000, stalls});
    all.push_back({"stalls, points", points, 0.03, 4, 20, 3, 1000, stalls});
    return all;
}

TEST(CostTraces, cost_at_most_2_percent_more_than_counting) {
    for (const Trace& trace : traces()) {
        double least = 2;
        double most = 0;
        double learned_share = 0;
        for (const std::uint64_t seed : {1, 2, 3}) {
            TraceRun learned(trace, true, seed);
            const double ratio = learned.cost() / TraceRun(trace, false, seed).cost();
            least = std::min(least, ratio);
            most = std::max(most, ratio);
            learned_share += learned.learned() / 3;
        }
        std::printf("| %s | %.1f ... %.1f %% | %.0f %% |\n", trace.name.c_str(), 100 * (least - 1),
                    100 * (most - 1), 100 * learned_share);
        EXPECT_LE(most, 1.025) << trace.name;
    }
}

TEST(CostTraces, gain_if_columns_explain_the_costs) {
    for (const double noise : {0.0, 0.1}) {
        const Trace trace{"columns", columns, noise, 8, 20, 3, 3000};
        EXPECT_LE(TraceRun(trace, true).cost(), 0.9 * TraceRun(trace, false).cost());
    }
}

}  // namespace
}  // namespace rrcb::test
