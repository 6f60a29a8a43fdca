// Costs that appear late, and outliers: the ranks of a run in one process.
#include "controller/cost_rule.hpp"

#include "../support/common.hpp"
#include "controller/step_record.hpp"

namespace rrcb {
namespace {

/// Four ranks with as many points, of which each takes 1, and other cells, which take 2 each.
class Ranks {
  public:
    void step(bool has_cells, double stall = 0) {
        std::vector<double> joined;
        for (int rank = 0; rank < num_ranks; ++rank) {
            CostRule& rule = rules_[rank];
            if (!joined_.empty()) rule.take(joined_);
            const double cells = has_cells ? 10.0 + 10 * rank : 0;
            const double seconds = 100 + 2 * cells + (rank == 0 ? stall : 0);
            const auto mine = rule.hand_in(seconds, std::vector<double>{100, cells});
            if (joined.empty())
                joined.assign(mine.begin(), mine.end());
            else
                join_carried(mine, joined);
        }
        joined_ = joined;
    }

    /// Steps with cells until their cost is learned to 5 %, of 200 at most.
    int steps_to_learn() {
        for (int steps = 1; steps < 200; ++steps) {
            step(true);
            if (std::abs(cost() - 2) < 0.1) return steps;
        }
        return 200;
    }

    double cost() const { return rules_[0].costs()[1]; }

  private:
    static constexpr int num_ranks = 4;
    std::vector<CostRule> rules_{{2, 0, 4}, {2, 1, 4}, {2, 2, 4}, {2, 3, 4}};
    std::vector<double> joined_;
};

TEST(CostRule, learns_a_column_after_many_zeros_as_fast_as_at_once) {
    const int at_once = Ranks().steps_to_learn();
    Ranks late;
    for (int step = 0; step < 10000; ++step) late.step(false);
    EXPECT_LE(late.steps_to_learn(), at_once + 2);
}

TEST(CostRule, cuts_a_stall_also_after_a_column_has_appeared) {
    Ranks ranks;
    for (int step = 0; step < 1000; ++step) ranks.step(false);
    for (int step = 0; step < 20; ++step) ranks.step(true);
    ranks.step(true, 5000);
    for (int step = 0; step < 3; ++step) ranks.step(true);
    EXPECT_NEAR(ranks.cost(), 2, 0.1);
}

}  // namespace
}  // namespace rrcb
