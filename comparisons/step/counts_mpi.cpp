#include "counts_mpi.hpp"

#include "failure.hpp"
#include "memory_layer.hpp"
#include "traffic.hpp"

#include <mpi.h>

#include <algorithm>
#include <numeric>
#include <span>
#include <tuple>

namespace comparisons {

namespace {

/// The number of steps after which the buffers have reached their final sizes.
constexpr int steps_before = 3;

/// Returns the indices that sort the ids in ascending order.
std::vector<std::size_t> order_of(const std::vector<std::int64_t>& ids) {
    std::vector<std::size_t> order(ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return ids[i]; });
    return order;
}

std::vector<double> sorted(const std::vector<double>& values, std::size_t width,
                           const std::vector<std::size_t>& order) {
    std::vector<double> result;
    result.reserve(values.size());
    for (const std::size_t i : order)
        result.insert(result.end(), &values[i * width], &values[i * width] + width);
    return result;
}

/// Returns the points and the ghosts, sorted by id.
Particles sorted(const Particles& p) {
    Particles result{p.dimension};
    const std::vector<std::size_t> points = order_of(p.ids);
    const std::vector<std::size_t> ghosts = order_of(p.ghost_ids);
    for (const auto& [to, from] : {std::pair(&result.x, &p.x), std::pair(&result.v, &p.v),
                                   std::pair(&result.forces, &p.forces)})
        *to = sorted(*from, p.width(), points);
    for (const auto& [to, from] :
         {std::pair(&result.ghost_x, &p.ghost_x), std::pair(&result.ghost_v, &p.ghost_v)})
        *to = sorted(*from, p.width(), ghosts);
    for (const std::size_t i : points) result.ids.push_back(p.ids[i]);
    for (const std::size_t i : ghosts) result.ghost_ids.push_back(p.ghost_ids[i]);
    return result;
}

bool are_same(const Particles& a, const Particles& b) {
    const auto all = [](const Particles& p) {
        return std::tie(p.ids, p.x, p.v, p.forces, p.ghost_ids, p.ghost_x, p.ghost_v);
    };
    return all(a) == all(b);
}

}  // namespace

std::vector<std::string> stage_names(const Arm& arm) {
    std::vector<std::string> names;
    for (const Stage& stage : arm) names.push_back(stage.name);
    for (const Stage& stage : std::span(arm).last(2)) names.push_back("kept " + stage.name);
    return names;
}

void run(const Arm& arm, const Flow& flow, int steps, const Observer& observer) {
    Particles particles = flow.start();
    const auto step_of = [&](std::span<const Stage> stages, std::size_t first, bool is_measured) {
        for (std::size_t k = 0; k < stages.size(); ++k) {
            if (k + 1 == stages.size()) flow.push(particles);
            const auto call = [&] { stages[k].call(particles); };
            is_measured ? observer.around(first + k, call) : call();
        }
    };
    int number = 0;
    for (int step = -steps_before; step < steps; ++step) {
        flow.move(particles, number);
        step_of(arm, 0, step >= 0);
        observer.after(number++, particles);
    }
    for (int step = -1; step < steps; ++step) {
        step_of(std::span(arm).last(2), arm.size(), step >= 0);
        observer.after(number++, particles);
    }
}

std::vector<StageCounts> count(std::string_view arm, const Flow& flow, int steps) {
    std::vector<StageCounts> counts(stage_names(make_arm(arm, flow)).size());
    run(make_arm(arm, flow), flow, steps,
        {[&](std::size_t stage, const std::function<void()>& call) {
            start_counting_traffic();
            call();
            const Traffic traffic = stop_counting_traffic();
            counts[stage].collectives += static_cast<double>(traffic.collectives);
            counts[stage].messages += static_cast<double>(traffic.messages - traffic.collectives);
            counts[stage].bytes += static_cast<double>(traffic.bytes);
        }});
    run(make_arm(arm, flow), flow, steps,
        {[&](std::size_t stage, const std::function<void()>& call) {
            memory_layer::fail_allocation(0);
            call();
            counts[stage].allocations += static_cast<double>(memory_layer::counted_allocations());
            counts[stage].bytes_allocated += static_cast<double>(memory_layer::counted_bytes());
        }});
    for (StageCounts& stage : counts)
        for (double* number : {&stage.collectives, &stage.messages, &stage.bytes,
                               &stage.allocations, &stage.bytes_allocated}) {
            MPI_Allreduce(MPI_IN_PLACE, number, 1, MPI_DOUBLE, MPI_SUM, flow.comm());
            *number /= flow.num_ranks() * steps;
        }
    return counts;
}

void SameResults::check(std::string_view arm, int step, const Particles& particles) {
    if (first_.empty()) first_ = arm;
    const Particles result = sorted(particles);
    const auto [known, is_first] = results_.try_emplace(step, result);
    if (!is_first && !are_same(known->second, result))
        throw Failure("in step " + std::to_string(step) + " the points, ghosts or sums of " +
                      std::string(arm) + " are not those of " + first_);
}

}  // namespace comparisons
