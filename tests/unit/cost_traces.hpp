#pragma once

#include "../support/common.hpp"
#include "controller/cost_rule.hpp"
#include "controller/step_record.hpp"

#include <rrcb/rrcb.hpp>

namespace rrcb::test {

/// Numbers of a rank that its true seconds depend on.
struct RankSums {
    int rank = 0;
    int step = 0;
    double points = 0;
    double cells = 0;   ///< that hold a point of it
    double shared = 0;  ///< of these, cells with points of another rank, too
    double hidden = 0;  ///< points in a region that no column shows, as are the next two
    double band = 0;
    double clustered = 0;
};

/// A run of points, half of which move in a cluster through the others, divided by the library.
struct Trace {
    std::string name;
    std::function<double(const RankSums&)> seconds;  ///< true ones
    double noise = 0.03;  ///< standard deviation of the measured ones over the true
    int num_ranks = 8;
    int every = 20;       ///< steps between rebalances
    int num_columns = 3;  ///< points, cells, shared; then the points again, 0, the points, ...
    double turn = 1000;   ///< steps in which the cluster moves round a circle
    /// What a clock shows for some seconds on a rank at a step.
    std::function<double(double, const RankSums&)> clock = [](double s, const RankSums&) {
        return s;
    };
};

/// Simulates a trace with weights of the cost model or by counting.
class TraceRun {
  public:
    TraceRun(const Trace& trace, bool learns, std::uint64_t seed = 1)
        : trace_(trace), learns_(learns), random_(seed), sums_(trace.num_ranks) {
        std::uniform_real_distribution<double> flat;
        for (int i = 0; i < num_points; ++i) {
            const bool clustered = i % 2 == 0;
            x_.push_back(clustered ? 0.3 + 0.04 * normal_(random_) : flat(random_));
            x_.push_back(clustered ? 0.5 + 0.04 * normal_(random_) : flat(random_));
        }
        start_ = x_;
        for (int r = 0; r < trace.num_ranks; ++r)
            rules_.emplace_back(trace.num_columns, r, trace.num_ranks);
    }

    /// True seconds of the slowest rank, summed over 400 steps.
    double cost() {
        double total = 0;
        for (int step = 0; step < num_steps; ++step) {
            move(step);
            if (step % trace_.every == 0) divide();
            assign(cuts_, Points(x_, 2), parts_);
            count(step);
            double slowest = 0;
            for (const RankSums& sums : sums_) slowest = std::max(slowest, trace_.seconds(sums));
            total += slowest;
            measure();
        }
        return total;
    }

    /// Share of the rebalances that used learned costs.
    double learned() const { return static_cast<double>(num_learned_) / num_rebalances_; }

  private:
    static constexpr int num_steps = 400;
    static constexpr int num_points = 1500;
    static constexpr int width = 24;
    static constexpr int num_cells = width * width;

    void move(int step) {
        const double angle = 2 * std::acos(-1.0) * step / trace_.turn;
        for (int i = 0; i < num_points; i += 2) {
            x_[2 * i] = std::clamp(start_[2 * i] + 0.3 * (1 - std::cos(angle)), 0.0, 1.0);
            x_[2 * i + 1] = std::clamp(start_[2 * i + 1] + 0.3 * std::sin(angle), 0.0, 1.0);
        }
    }

    int cell_of(int i) const {
        const auto along = [](double x) {
            return std::min(width - 1, static_cast<int>(x * width));
        };
        return along(x_[2 * i]) + width * along(x_[2 * i + 1]);
    }

    /// Points of each part in each cell.
    std::vector<int> occupancy() const {
        std::vector<int> counts(static_cast<std::size_t>(trace_.num_ranks * num_cells));
        for (int i = 0; i < num_points; ++i) ++counts[parts_[i] * num_cells + cell_of(i)];
        return counts;
    }

    std::vector<double> columns_of(double points, double cells, double shared) const {
        std::vector<double> columns{points, cells, shared};
        while (static_cast<int>(columns.size()) < trace_.num_columns)
            columns.push_back(columns.size() % 2 == 1 ? points : 0);
        columns.resize(trace_.num_columns);
        return columns;
    }

    void divide() {
        Options options{.num_parts = trace_.num_ranks, .refine = Refine::exact};
        std::vector<double> weights;
        ++num_rebalances_;
        if (learns_ && rules_.front().uses_costs()) {
            ++num_learned_;
            const std::vector<int> counts = occupancy();
            for (int i = 0; i < num_points; ++i)
                weights.push_back(rules_.front().weight(
                    columns_of(1, 1.0 / counts[parts_[i] * num_cells + cell_of(i)], 0)));
        }
        for (CostRule& rule : rules_) rule.divide();
        cuts_ = balance(Points(x_, 2, weights), MPI_COMM_SELF, options).cuts;
    }

    void count(int step) {
        for (int r = 0; r < trace_.num_ranks; ++r) sums_[r] = {r, step};
        for (int i = 0; i < num_points; ++i) {
            ++sums_[parts_[i]].points;
            if (x_[2 * i] > 0.6) ++sums_[parts_[i]].hidden;
            if (std::abs(x_[2 * i + 1] - 0.6) < 0.1) ++sums_[parts_[i]].band;
            if (i % 2 == 0) ++sums_[parts_[i]].clustered;
        }
        const std::vector<int> counts = occupancy();
        for (int cell = 0; cell < num_cells; ++cell) {
            const auto holds = [&](int r) { return counts[r * num_cells + cell] > 0; };
            int holders = 0;
            for (int r = 0; r < trace_.num_ranks; ++r) holders += holds(r) ? 1 : 0;
            for (int r = 0; r < trace_.num_ranks; ++r) {
                if (!holds(r)) continue;
                ++sums_[r].cells;
                if (holders > 1) ++sums_[r].shared;
            }
        }
    }

    void measure() {
        std::vector<double> all(rules_.front().num_sums());
        for (const RankSums& sums : sums_) {
            const double noise = std::max(0.0, 1 + trace_.noise * normal_(random_));
            const double seconds = trace_.clock(trace_.seconds(sums) * noise, sums);
            join_carried(rules_[sums.rank].hand_in(
                             seconds, columns_of(sums.points, sums.cells, sums.shared)),
                         all);
        }
        for (CostRule& rule : rules_) rule.take(all);
    }

    const Trace& trace_;
    bool learns_;
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
    std::vector<double> x_, start_;
    std::vector<RankSums> sums_;
    std::vector<CostRule> rules_;
    Cuts cuts_;
    std::vector<Part> parts_ = std::vector<Part>(num_points);
    int num_rebalances_ = 0;
    int num_learned_ = 0;
};

}  // namespace rrcb::test
