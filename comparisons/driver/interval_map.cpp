#include "interval_map.hpp"

#include "rebalance_policies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

namespace comparisons {

namespace {

double ideal(const LoadHistory& history) {
    double sum = 0;
    for (int step = 0; step < history.num_steps; ++step) sum += history.load(step, step).mean;
    return sum;
}

double overhead(const LoadHistory& history, double cost) {
    return cost / ideal(history) - 1;
}

double excess(const rrcb::StepLoad& load) {
    return load.heaviest / load.mean - 1;
}

LoadHistory with_costs_times(const LoadHistory& history, double factor) {
    LoadHistory scaled = history;
    scaled.cost = [cost = history.cost, factor](int step) { return factor * cost(step); };
    return scaled;
}

/// The interval of least overhead among the mapped ones.
std::pair<double, int> best_interval(const LoadHistory& history) {
    std::pair<double, int> best{std::numeric_limits<double>::infinity(), 1};
    for (const int every : mapped_intervals(history.num_steps)) {
        best = std::min(best, {overhead_of_interval(history, every), every});
    }
    return best;
}

Optimum optimum_of(const MappedScene& scene, const MappedMethod& method) {
    const LoadHistory& history = method.history;
    Optimum result{.scene = scene.scene,
                   .num_ranks = scene.num_ranks,
                   .method = method.method,
                   .model = growth_in_a_cycle(history),
                   .cost_s = method.cost_s,
                   .call_s = method.call_s};
    std::tie(result.overhead, result.best_every) = best_interval(history);
    const auto best_at = [&](double factor) {
        return best_interval(with_costs_times(history, factor)).first;
    };
    result.overhead95 = {best_at(method.cost_scale.low), best_at(method.cost_scale.high)};
    result.predicted_every = predicted_interval(result.model, history.num_steps);
    result.predicted = predicted_overhead(result.model, result.predicted_every);
    result.of_controller = overhead_of_controller(history);
    return result;
}

/// Lets a policy decide, and notes what it sees: a row for each step.
class Witness : public Policy {
  public:
    /// `key` is the beginning of every row; `paid` what the parts of the start have cost.
    Witness(std::vector<Row>& rows, Row key, std::unique_ptr<Policy> policy, double paid)
        : rows_(rows), key_(std::move(key)), policy_(std::move(policy)), paid_(paid) {}

    void rebalanced(double cost) override {
        if (step_ > 0) paid_ += cost;
        policy_->rebalanced(cost);
    }

    bool step(const rrcb::StepLoad& load) override {
        paid_ += load.heaviest - load.mean;
        rows_.push_back(Row(key_)
                            .add("step", step_++)
                            .add("imbalance", load.heaviest / load.mean)
                            .add("rebalanced", is_fresh_ ? 1 : 0)
                            .add("lost", paid_));
        return is_fresh_ = policy_->step(load);
    }

  private:
    std::vector<Row>& rows_;
    Row key_;
    std::unique_ptr<Policy> policy_;
    double paid_;
    int step_ = 0;
    bool is_fresh_ = false;
};

Row key_of(const MappedScene& scene, const std::string& method, const std::string& every) {
    return Row()
        .add("scene", scene.scene)
        .add("ranks", scene.num_ranks)
        .add("method", method)
        .add("every", every);
}

Row row_of(const Optimum& optimum) {
    return Row()
        .add("scene", optimum.scene)
        .add("ranks", optimum.num_ranks)
        .add("method", optimum.method)
        .add("best_every", optimum.best_every)
        .add("overhead", optimum.overhead)
        .add("predicted_every", optimum.predicted_every)
        .add("predicted_overhead", optimum.predicted)
        .add("auto_overhead", optimum.of_controller)
        .add_interval("overhead_", optimum.overhead95)
        .add("cost_ms", optimum.cost_s * 1e3)
        .add("call_ms", optimum.call_s * 1e3)
        .add("cost_steps", optimum.model.cost)
        .add("floor", optimum.model.floor)
        .add("growth", optimum.model.growth);
}

}  // namespace

double predicted_overhead(const LinearGrowth& model, int every) {
    return model.cost / every + model.floor + model.growth * (every - 1) / 2;
}

int predicted_interval(const LinearGrowth& model, int num_steps) {
    const double best = std::sqrt(2 * model.cost / model.growth);
    if (!(model.growth > 0) || !(best < num_steps)) return num_steps;
    const int below = std::max(1, static_cast<int>(best));
    const int above = std::min(below + 1, num_steps);
    return predicted_overhead(model, above) < predicted_overhead(model, below) ? above : below;
}

LinearGrowth linear_growth(const LoadHistory& history, int stretch) {
    LinearGrowth model;
    const int num_made = history.num_steps - stretch;
    for (int made = 0; made < num_made; ++made) {
        const double fresh = excess(history.load(made, made));
        const double grown = excess(history.load(made, made + stretch)) - fresh;
        model.cost += history.cost(made) / history.load(made, made).mean / num_made;
        model.floor += fresh / num_made;
        model.growth += grown / stretch / num_made;
    }
    return model;
}

LinearGrowth growth_in_a_cycle(const LoadHistory& history) {
    constexpr int max_rounds = 20;
    const int most = std::max(1, history.num_steps / 4);
    int stretch = std::max(1, most / 10);
    LinearGrowth model = linear_growth(history, stretch);
    for (int round = 0; round < max_rounds; ++round) {
        const int next = std::min(predicted_interval(model, history.num_steps), most);
        if (next == stretch) break;
        stretch = (stretch + next) / 2;
        model = linear_growth(history, stretch);
    }
    return model;
}

double overhead_of_interval(const LoadHistory& history, int every) {
    return overhead(history, history.cost(0) + cost_of_interval(history, every));
}

double overhead_of_controller(const LoadHistory& history) {
    return overhead(history, history.cost(0) + cost_of(history, *controller_policy()));
}

double overhead_of_none(const LoadHistory& history) {
    return overhead(history, cost_of_interval(history, history.num_steps));
}

std::vector<int> mapped_intervals(int num_steps) {
    std::vector<int> intervals;
    for (double decade = 1; decade < num_steps; decade *= 10) {
        for (const double factor : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
            const double every = factor * decade;
            if (every == std::floor(every) && every < num_steps) {
                intervals.push_back(static_cast<int>(every));
            }
        }
    }
    intervals.push_back(num_steps);
    return intervals;
}

std::vector<Optimum> optima(const MappedScene& scene) {
    std::vector<Optimum> all;
    for (const MappedMethod& method : scene.methods) all.push_back(optimum_of(scene, method));
    return all;
}

std::vector<Row> map_rows(const MappedScene& scene) {
    std::vector<Row> rows;
    const auto add = [&](const std::string& method, const std::string& every, double overhead) {
        rows.push_back(key_of(scene, method, every).add("overhead", overhead));
    };
    add("none", "", overhead_of_none(scene.none));
    for (const MappedMethod& mapped : scene.methods) {
        const LoadHistory& history = mapped.history;
        for (const int every : mapped_intervals(history.num_steps))
            add(mapped.method, std::to_string(every), overhead_of_interval(history, every));
        add(mapped.method, "auto", overhead_of_controller(history));
    }
    return rows;
}

std::vector<Row> optimum_rows(const MappedScene& scene) {
    std::vector<Row> rows;
    for (const Optimum& optimum : optima(scene)) rows.push_back(row_of(optimum));
    return rows;
}

std::vector<Row> step_rows(const MappedScene& scene) {
    std::vector<Row> rows;
    const auto add = [&](const std::string& method, const std::string& every,
                         const LoadHistory& history, std::unique_ptr<Policy> policy, double paid) {
        Witness witness(rows, key_of(scene, method, every), std::move(policy), paid);
        cost_of(history, witness);
    };
    add("none", "", scene.none, interval_policy(scene.none.num_steps), 0);
    for (const MappedMethod& method : scene.methods) {
        const LoadHistory& history = method.history;
        const int every = best_interval(history).second;
        add(method.method, std::to_string(every), history, interval_policy(every), history.cost(0));
        add(method.method, "auto", history, controller_policy(), history.cost(0));
    }
    return rows;
}

}  // namespace comparisons
