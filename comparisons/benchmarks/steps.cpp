// Steps of the material point method on one core: what a scene's points cost, beside the bandwidth
// of memory.

#include <benchmark/benchmark.h>
#include <mpi.h>
#include <mpm/region.hpp>
#include <mpm/simulation.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace mpm::benchmarks {
namespace {

struct Method {
    const char* name;
    int dimension;
    ShapeFunction shape_function;
    const char* model;
};

constexpr std::array<Method, 5> methods{{
    {"elastic_2d_linear", 2, ShapeFunction::linear, "elastic"},
    {"drucker_prager_2d_linear", 2, ShapeFunction::linear, "drucker_prager"},
    {"drucker_prager_2d_quadratic", 2, ShapeFunction::quadratic, "drucker_prager"},
    {"elastic_3d_linear", 3, ShapeFunction::linear, "elastic"},
    {"drucker_prager_3d_quadratic", 3, ShapeFunction::quadratic, "drucker_prager"},
}};

Material soil(const std::string& model) {
    Material material{"soil", model, {}};
    material.parameters = {{"density", 2100.0}, {"youngs_modulus", 70e6}, {"poissons_ratio", 0.3}};
    if (model == "drucker_prager") {
        material.parameters["cohesion"] = 10e3;
        material.parameters["friction_angle"] = 20.0;
    }
    return material;
}

/// A box of soil with two points along each axis of a cell, which settles under its weight.
Scene box_of_soil(const Method& method, std::int64_t num_points) {
    const double cells = static_cast<double>(num_points) / std::pow(2, method.dimension);
    const int per_axis = static_cast<int>(std::lround(std::pow(cells, 1.0 / method.dimension)));
    const auto side = static_cast<double>(per_axis);
    Scene scene{
        .name = "box",
        .dimension = method.dimension,
        .grid = {.spacing = 1, .num_cells = {per_axis, per_axis + 2, per_axis}},
        .materials = {soil(method.model)},
        .bodies = {{.contains = box_region({{0, 0, 0}, {side, side, side}}), .material = "soil"}}};
    for (Wall* wall : {&scene.walls.left, &scene.walls.right, &scene.walls.bottom})
        *wall = Wall::roller;
    if (method.dimension == 3) scene.walls.back = scene.walls.front = Wall::roller;
    std::vector<double> gravity(static_cast<std::size_t>(method.dimension), 0.0);
    gravity[1] = -9.81;
    scene.effects = {{"gravity", {{"acceleration", gravity}}}};
    scene.shape_function = method.shape_function;
    return scene;
}

/// Bytes between memory and core of a point in a step where nothing stays in the cache between
/// passes: cells, owners and speed read D columns each; p2g reads mass, volume, position, velocity
/// and stress; g2p reads and writes volume, position and velocity, the material all stresses.
double bytes_per_point(int dimension) {
    const double d = dimension, stresses = dimension == 2 ? 4 : 6;
    const double read_by_p2g = 2 + 2 * d + d * (d + 1) / 2;
    return sizeof(double) * (3 * d + read_by_p2g + 2 * (1 + 2 * d) + 2 * stresses);
}

void step(benchmark::State& state, const Method& method) {
    Simulation simulation(box_of_soil(method, state.range(0)), MPI_COMM_SELF);
    for (auto _ : state) simulation.step();
    const double point_steps =
        static_cast<double>(simulation.num_points()) * static_cast<double>(state.iterations());
    state.counters["point_steps"] = benchmark::Counter(point_steps, benchmark::Counter::kIsRate);
    state.counters["bytes"] = benchmark::Counter(point_steps * bytes_per_point(method.dimension),
                                                 benchmark::Counter::kIsRate);
}

/// The yardstick: a = b + 3 c, as McCalpin's STREAM counts it, 24 bytes an entry.
void triad(benchmark::State& state) {
    const auto count = static_cast<std::size_t>(state.range(0));
    std::vector<double> a(count), b(count, 1.0), c(count, 2.0);
    for (auto _ : state) {
        for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 3 * c[i];
        benchmark::DoNotOptimize(a.data());
        benchmark::ClobberMemory();
    }
    const double moved = 3 * sizeof(double) * static_cast<double>(count);
    state.counters["bytes"] = benchmark::Counter(moved * static_cast<double>(state.iterations()),
                                                 benchmark::Counter::kIsRate);
}

void add_all() {
    constexpr std::int64_t in_cache = 60'000, in_memory = 1'000'000;
    for (const std::int64_t count : {in_cache, 10 * in_memory})
        benchmark::RegisterBenchmark("triad", triad)
            ->ArgName("numbers")
            ->Arg(count)
            ->Unit(benchmark::kMillisecond);
    for (const Method& method : methods)
        benchmark::RegisterBenchmark(method.name, step, method)
            ->ArgName("points")
            ->Args({1000})
            ->Args({in_cache})
            ->Args({in_memory})
            ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace mpm::benchmarks

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    mpm::benchmarks::add_all();
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
    MPI_Finalize();
}
