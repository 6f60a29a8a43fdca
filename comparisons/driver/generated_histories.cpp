#include "generated_histories.hpp"

#include "counter_random.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

namespace comparisons {

namespace {

constexpr int num_ranks = 8;
constexpr int num_steps = 1000;
constexpr double two_pi = 2 * std::numbers::pi;

using Ranks = std::array<double, num_ranks>;

/// Load of rank p in a step t, its parts made before step s:
///
///     base(t) noise_p(t) max(0.05, 1 + drift_p(t) - drift_p(s) + kept_p (1 - 2^-((t - s) /
///     decay)))
struct Model {
    std::vector<Ranks> drift = std::vector<Ranks>(num_steps);
    std::vector<Ranks> noise = std::vector<Ranks>(num_steps);
    std::vector<double> base = std::vector<double>(num_steps, 1);
    std::vector<double> cost = std::vector<double>(num_steps);
    Ranks kept{};      ///< that no rebalance removes for long
    double decay = 0;  ///< steps until half of it is back; 0: it never goes

    Model() {
        for (Ranks& factors : noise) factors.fill(1);
    }

    rrcb::StepLoad load(int made, int step) const {
        const auto s = static_cast<std::size_t>(made);
        const auto t = static_cast<std::size_t>(step);
        const double back = decay > 0 ? 1 - std::exp2((made - step) / decay) : 1;
        rrcb::StepLoad load;
        for (std::size_t p = 0; p < num_ranks; ++p) {
            const double share = 1 + drift[t][p] - drift[s][p] + kept[p] * back;
            const double mine = base[t] * noise[t][p] * std::max(0.05, share);
            load.mean += mine / num_ranks;
            load.heaviest = std::max(load.heaviest, mine);
        }
        return load;
    }
};

/// Numbers of the ranks, of mean 0.
Ranks spread(CounterRandom& random, double largest) {
    Ranks ranks{};
    double mean = 0;
    for (double& value : ranks) mean += (value = random.uniform(-largest, largest)) / num_ranks;
    for (double& value : ranks) value -= mean;
    return ranks;
}

double log_uniform(CounterRandom& random, double lower, double upper) {
    return lower * std::pow(upper / lower, random.uniform());
}

void add(Ranks& ranks, const Ranks& others, double factor = 1) {
    for (std::size_t p = 0; p < num_ranks; ++p) ranks[p] += factor * others[p];
}

void add_growth(Model& model, CounterRandom& random) {
    const Ranks rate = spread(random, log_uniform(random, 0.0005, 0.02));
    for (std::size_t t = 0; t < num_steps; ++t) add(model.drift[t], rate, static_cast<double>(t));
}

void add_jumps(Model& model, CounterRandom& random) {
    const double mean_wait = random.uniform(30, 150);
    const double largest = random.uniform(0.2, 1);
    Ranks at{};
    for (std::size_t t = 0; t < num_steps; ++t) {
        if (random.uniform() < 1 / mean_wait) add(at, spread(random, largest));
        add(model.drift[t], at);
    }
}

void add_oscillation(Model& model, CounterRandom& random) {
    const double period = log_uniform(random, 10, 300);
    const Ranks amplitude = spread(random, random.uniform(0.05, 0.4));
    const Ranks phase = spread(random, std::numbers::pi);
    for (std::size_t t = 0; t < num_steps; ++t)
        for (std::size_t p = 0; p < num_ranks; ++p)
            model.drift[t][p] +=
                amplitude[p] * std::sin(two_pi * static_cast<double>(t) / period + phase[p]);
}

/// Of each rank and step, and now and then a step that something else has slowed down.
void add_noise(Model& model, CounterRandom& random, double deviation) {
    for (Ranks& factors : model.noise)
        for (double& factor : factors) {
            const double normal = std::sqrt(-2 * std::log(1 - random.uniform())) *
                                  std::cos(two_pi * random.uniform());
            factor *= std::exp(deviation * normal);
            if (random.uniform() < 0.002) factor *= random.uniform(2, 10);
        }
}

void add_walk(Model& model, CounterRandom& random) {
    const double stride = log_uniform(random, 0.005, 0.05);
    Ranks at{};
    for (Ranks& drift : model.drift) {
        add(at, spread(random, stride));
        add(drift, at);
    }
}

/// Growth that pauses and goes on elsewhere.
void add_bursts(Model& model, CounterRandom& random) {
    Ranks at{};
    Ranks rate{};
    for (Ranks& drift : model.drift) {
        if (random.uniform() < 0.01) {
            const bool pauses = random.uniform() < 0.5;
            rate = pauses ? Ranks{} : spread(random, log_uniform(random, 0.002, 0.03));
        }
        add(at, rate);
        add(drift, at);
    }
}

void set_cost(Model& model, double cost) {
    std::ranges::fill(model.cost, cost);
}

void grow_cost(Model& model, double factor) {
    for (std::size_t t = 0; t < num_steps; ++t)
        model.cost[t] *= std::pow(factor, static_cast<double>(t) / num_steps);
}

void vary_base(Model& model, CounterRandom& random) {
    const double period = log_uniform(random, 5, 100);
    for (std::size_t t = 0; t < num_steps; ++t)
        model.base[t] = 1 + 0.5 * std::sin(two_pi * static_cast<double>(t) / period);
}

struct Kind {
    const char* name;
    void (*build)(Model&, CounterRandom&);
};

constexpr Kind kinds[] = {
    {"growth", add_growth},
    {"jumps", add_jumps},
    {"oscillation", add_oscillation},
    {"noisy growth",
     [](Model& model, CounterRandom& random) {
         add_growth(model, random);
         add_noise(model, random, random.uniform(0.02, 0.1));
     }},
    {"growth of loads and costs",
     [](Model& model, CounterRandom& random) {
         add_growth(model, random);
         grow_cost(model, 5);
     }},
    {"nothing but noise",
     [](Model& model, CounterRandom& random) { add_noise(model, random, 0.02); }},
    {"bursts", add_bursts},
    {"random walk", add_walk},
    {"imbalance that stays or returns",
     [](Model& model, CounterRandom& random) {
         model.kept = spread(random, random.uniform(0.1, 0.6));
         model.decay = random.uniform() < 0.5 ? 0 : random.uniform(2, 40);
         vary_base(model, random);
         add_growth(model, random);
     }},
    {"all at once",
     [](Model& model, CounterRandom& random) {
         for (const auto add_some : {add_growth, add_jumps, add_oscillation, add_walk, vary_base})
             add_some(model, random);
         model.kept = spread(random, 0.1);
         add_noise(model, random, 0.03);
         grow_cost(model, 0.3);
     }},
};

}  // namespace

std::vector<LoadHistory> generated_histories(std::uint64_t seed) {
    std::vector<LoadHistory> histories;
    for (const Kind& kind : kinds) {
        CounterRandom random(seed, histories.size());
        const auto model = std::make_shared<Model>();
        set_cost(*model, log_uniform(random, 0.3, 20));
        kind.build(*model, random);
        histories.push_back(
            {std::string(kind.name) + " " + std::to_string(seed), num_steps,
             [model](int made, int step) { return model->load(made, step); },
             [model](int step) { return model->cost[static_cast<std::size_t>(step)]; },
             seed % 2 == 1});
    }
    return histories;
}

}  // namespace comparisons
