#include "rebalance_policies.hpp"

#include <algorithm>
#include <limits>

namespace comparisons {

namespace {

using rrcb::StepLoad;

/// Decides as the controller does: what is decided by a step is heeded two steps later.
class ControllerPolicy : public Policy {
  public:
    void rebalanced(double cost) override { rule_.rebalanced(cost, 1); }

    bool step(const StepLoad& load) override {
        rule_.add(load);
        if (steps_to_go_ > 0) return --steps_to_go_ == 0;
        if (rule_.is_due()) steps_to_go_ = lag;
        return false;
    }

  private:
    static constexpr int lag = 2;
    rrcb::RebalanceRule rule_;
    int steps_to_go_ = 0;
};

/// Once t u(t) - sum u reaches the latest cost, of u as it comes.
class PlainPolicy : public Policy {
  public:
    void rebalanced(double cost) override {
        cost_ = cost;
        sum_ = 0;
        num_steps_ = 0;
    }

    bool step(const StepLoad& load) override {
        const double waste = load.heaviest - load.mean;
        sum_ += waste;
        return ++num_steps_ * waste - sum_ >= cost_;
    }

  private:
    double cost_ = 0;
    double sum_ = 0;
    int num_steps_ = 0;
};

/// Once the imbalance has been larger for some steps, then none for a while.
class ThresholdPolicy : public Policy {
  public:
    ThresholdPolicy(double imbalance, int num_steps, int num_rest)
        : imbalance_(imbalance), num_steps_(num_steps), num_rest_(num_rest) {}

    void rebalanced(double) override {}

    bool step(const StepLoad& load) override {
        if (steps_to_rest_ > 0) {
            --steps_to_rest_;
            return false;
        }
        num_larger_ = load.heaviest > imbalance_ * load.mean ? num_larger_ + 1 : 0;
        if (num_larger_ < num_steps_) return false;
        num_larger_ = 0;
        steps_to_rest_ = num_rest_;
        return true;
    }

  private:
    double imbalance_;
    int num_steps_;
    int num_rest_;
    int num_larger_ = 0;
    int steps_to_rest_ = 0;
};

class IntervalPolicy : public Policy {
  public:
    explicit IntervalPolicy(int interval) : interval_(interval) {}

    void rebalanced(double) override {}
    bool step(const StepLoad&) override { return ++num_steps_ % interval_ == 0; }

  private:
    int interval_;
    int num_steps_ = 0;
};

}  // namespace

std::unique_ptr<Policy> interval_policy(int interval) {
    return std::make_unique<IntervalPolicy>(interval);
}

std::unique_ptr<Policy> controller_policy() {
    return std::make_unique<ControllerPolicy>();
}

std::vector<NamedPolicy> policies() {
    std::vector<NamedPolicy> all = {
        {"controller", controller_policy},
        {"plain criterion", [] { return std::make_unique<PlainPolicy>(); }},
        {"imbalance 1.35 for 3 steps; 100 of rest",
         [] { return std::make_unique<ThresholdPolicy>(1.35, 3, 100); }},
        {"imbalance 1.1", [] { return std::make_unique<ThresholdPolicy>(1.1, 1, 0); }}};
    for (const int interval : {1, 5, 20, 100}) {
        all.push_back({"every " + std::to_string(interval),
                       [interval] { return interval_policy(interval); }});
    }
    all.push_back({"never", [] { return interval_policy(std::numeric_limits<int>::max()); }});
    return all;
}

double cost_of(const LoadHistory& history, Policy& policy) {
    if (history.cost_is_known) policy.rebalanced(history.cost(0));
    double total = 0;
    int made = 0;
    for (int step = 0; step < history.num_steps; ++step) {
        const StepLoad load = history.load(made, step);
        total += load.heaviest;
        if (!policy.step(load) || step + 1 == history.num_steps) continue;
        made = step + 1;
        total += history.cost(made);
        policy.rebalanced(history.cost(made));
    }
    return total;
}

double cost_of_interval(const LoadHistory& history, int interval) {
    IntervalPolicy policy(interval);
    return cost_of(history, policy);
}

double cost_of_best_interval(const LoadHistory& history) {
    double least = std::numeric_limits<double>::infinity();
    for (int interval = 1; interval <= history.num_steps; ++interval) {
        least = std::min(least, cost_of_interval(history, interval));
    }
    return least;
}

double optimum(const LoadHistory& history) {
    // least[s]: of the steps before s, where parts are made before step s
    std::vector<double> least(static_cast<std::size_t>(history.num_steps) + 1,
                              std::numeric_limits<double>::infinity());
    least[0] = 0;
    for (int made = 0; made < history.num_steps; ++made) {
        double total = least[static_cast<std::size_t>(made)] + (made > 0 ? history.cost(made) : 0);
        for (int step = made; step < history.num_steps; ++step) {
            total += history.load(made, step).heaviest;
            double& to_next = least[static_cast<std::size_t>(step) + 1];
            to_next = std::min(to_next, total);
        }
    }
    return least.back();
}

}  // namespace comparisons
