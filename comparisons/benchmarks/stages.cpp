#include "clouds.hpp"
#include "passes/assignment.hpp"
#include "passes/binned_points.hpp"
#include "passes/collected.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/method/moments.hpp>
#include <rrcb/plan.hpp>

#include <benchmark/benchmark.h>
#include <mpi.h>

#include <array>

namespace rrcb::benchmarks {
namespace {

constexpr int cells_per_axis = 16;  // the default for many points in 2-D
constexpr int num_parts = 8;

Order order_of(const benchmark::State& state) {
    return state.range(1) == 0 ? Order::scattered : Order::by_position;
}

/// Runs `step(points)` again and again; reports the time per point.
template <class Step>
void run(benchmark::State& state, Step&& step) {
    const auto count = static_cast<std::size_t>(state.range(0));
    const std::vector<double> coordinates = slope_cloud(count, order_of(state));
    const Points points = interleaved_points(coordinates, 2);
    for (auto _ : state) benchmark::DoNotOptimize(step(points));
    state.counters["per_point"] =
        benchmark::Counter(static_cast<double>(count) * static_cast<double>(state.iterations()),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// The yardstick: one pass that touches every coordinate once.
double sum_of(const Points& points) {
    std::array<double, 8> lanes{};
    const std::span<const double> all = points.axes[0];
    std::size_t k = 0;
    for (; k + lanes.size() <= all.size(); k += lanes.size())
        for (std::size_t lane = 0; lane < lanes.size(); ++lane) lanes[lane] += all[k + lane];
    for (; k < all.size(); ++k) lanes[0] += all[k];
    return lanes[0] + lanes[1] + lanes[2] + lanes[3] + lanes[4] + lanes[5] + lanes[6] + lanes[7];
}

Balance balance_alone(const Points& points) {
    Options options;
    options.num_parts = num_parts;
    return balance(points, options, {}, MPI_COMM_SELF);
}

void sum(benchmark::State& state) {
    run(state, sum_of);
}

void box(benchmark::State& state) {
    run(state, bounding_box);
}

BinnedPoints bin(const Points& points) {
    return bin_by_cell(points, make_support_mesh(bounding_box(points), 2, cells_per_axis));
}

void bins(benchmark::State& state) {
    run(state, bin);
}

void all(benchmark::State& state) {
    run(state, [](const Points& points) {
        Collected all;
        collect_all(points, all);
        return all;
    });
}

void moments(benchmark::State& state) {
    run(state, [](const Points& points) {
        return cell_moments(points, make_support_mesh(bounding_box(points), 2, cells_per_axis));
    });
}

void assignment(benchmark::State& state) {
    Cuts cuts;
    std::vector<Part> parts(static_cast<std::size_t>(state.range(0)));
    run(state, [&](const Points& points) {
        if (cuts.tree.empty()) cuts = balance_alone(points).cuts;
        return assign_and_count(cuts, points, parts).counts[0];
    });
}

void whole(benchmark::State& state) {
    run(state, balance_alone);
}

void exact(benchmark::State& state) {
    run(state, [](const Points& points) {
        Options options;
        options.num_parts = num_parts;
        options.refine = Refine::exact;
        return balance(points, options, {}, MPI_COMM_SELF);
    });
}

void lists(benchmark::State& state) {
    std::vector<Part> parts(static_cast<std::size_t>(state.range(0)));
    run(state, [&](const Points&) { return plan(parts, 1, MPI_COMM_SELF); });
}

}  // namespace
}  // namespace rrcb::benchmarks

int main(int argc, char** argv) {
    using namespace rrcb::benchmarks;
    struct Stage {
        const char* name;
        void (*run)(benchmark::State&);
    };
    MPI_Init(&argc, &argv);
    for (const Stage& stage : {Stage{"sum", sum},
                               {"bounding_box", box},
                               {"bin_by_cell", bins},
                               {"collect_all", all},
                               {"cell_moments", moments},
                               {"assign", assignment},
                               {"balance", whole},
                               {"balance_exact", exact},
                               {"plan", lists}}) {
        benchmark::RegisterBenchmark(stage.name, stage.run)
            ->ArgNames({"points", "by_position"})
            ->ArgsProduct({{1000, 125000, 1000000}, {0, 1}})
            ->Unit(benchmark::kMillisecond);
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    MPI_Finalize();
}
