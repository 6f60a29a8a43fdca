// dccrg_grid METHOD STEPS: cells of dccrg, the grid of Vlasiator, with weights as in a
// magnetosphere that drifts. METHOD is Zoltan's. Cells have as many values as their weights. Every
// step balances the cells, sends those that other ranks need, and works on all values. Prints what
// tests/hosts/run compares.
#include <dccrg.hpp>
#include <dccrg_cartesian_geometry.hpp>
#include <mpi.h>
#include <zoltan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <tuple>
#include <vector>

namespace {

constexpr int MAX_WEIGHT = 48, WORK = 20;

struct Cell {
    int weight = 1;
    std::array<double, MAX_WEIGHT> values{};

    std::tuple<void*, int, MPI_Datatype> get_mpi_datatype() {
        return {this, static_cast<int>(sizeof(Cell)), MPI_BYTE};
    }
};

using Grid = dccrg::Dccrg<Cell, dccrg::Cartesian_Geometry>;

/// Blocks of velocities: few in the solar wind, which comes from x > 0, and in the lobes of the
/// tail; most between bow shock and magnetopause, two paraboloids; some in the plasma sheet.
int weight_of(const std::array<double, 3>& x, std::uint64_t id, double nose) {
    const double bend = (x[1] * x[1] + x[2] * x[2]) / (2 * nose);
    const double noise = 0.8 + 0.4 * static_cast<double>(id * 2654435761U % 1024) / 1024;
    double weight = 1;
    if (x[0] < nose - 2 * bend)
        weight = std::abs(x[2]) < 0.1 ? 20 : 3;
    else if (x[0] < 1.3 * nose - bend)
        weight = 40;
    return std::max(static_cast<int>(std::lround(weight * noise)), 1);
}

void make(Grid& grid, const char* method) {
    dccrg::Cartesian_Geometry::Parameters box;
    box.start = {-2, -1, -1};
    box.level_0_cell_length = {0.1, 0.1, 0.1};
    grid.set_initial_length({30, 20, 20})
        .set_neighborhood_length(2)
        .set_maximum_refinement_level(1)
        .set_load_balancing_method(method)
        .initialize(MPI_COMM_WORLD)
        .set_geometry(box);
    for (const std::uint64_t id : grid.get_cells()) {
        const auto x = grid.geometry.get_center(id);
        if (std::hypot(x[0], x[1], x[2]) < 0.4) grid.refine_completely(id);
    }
    grid.stop_refining();
    for (const auto& cell : grid.local_cells())
        cell.data->values.fill(1e-3 * static_cast<double>(cell.id % 1000));
}

/// Returns the weight of the cells of this rank.
double set_weights(Grid& grid, double nose) {
    double sum = 0;
    for (const auto& cell : grid.local_cells()) {
        cell.data->weight = weight_of(grid.geometry.get_center(cell.id), cell.id, nose);
        grid.set_cell_weight(cell.id, cell.data->weight);
        sum += cell.data->weight;
    }
    return sum;
}

/// Returns the number of cells that come from other ranks.
double balance(Grid& grid) {
    auto before = grid.get_cells();
    grid.balance_load();
    const auto after = grid.get_cells();
    std::sort(before.begin(), before.end());
    return static_cast<double>(std::count_if(after.begin(), after.end(), [&](std::uint64_t cell) {
        return !std::binary_search(before.begin(), before.end(), cell);
    }));
}

void work(Grid& grid) {
    for (const auto& cell : grid.local_cells())
        for (int k = 0; k < cell.data->weight; ++k)
            for (int i = 0; i < WORK; ++i) cell.data->values[k] = std::sin(cell.data->values[k]);
}

/// Returns the sum and the maximum over the ranks.
std::array<double, 2> over_ranks(double value) {
    std::array<double, 2> result{};
    MPI_Allreduce(&value, &result[0], 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(&value, &result[1], 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return result;
}

void run(const char* method, int steps) {
    Grid grid;
    make(grid, method);
    int ranks = 0, rank = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    double moved = 0, imbalance = 0;
    for (int step = 0; step < steps; ++step) {
        const double nose = 0.3 + 0.002 * step;
        set_weights(grid, nose);
        const double arrived = balance(grid);
        // The first call distributes the grid.
        if (step > 0) moved += arrived;
        const auto weights = over_ranks(set_weights(grid, nose));
        imbalance += weights[1] * ranks / weights[0] / steps;
        grid.update_copies_of_remote_neighbors();
        work(grid);
    }
    double ghosts = 0, ghost_weight = 0, checksum = 0;
    for (const auto& cell : grid.remote_cells()) {
        ++ghosts;
        ghost_weight += cell.data->weight;
    }
    for (const auto& cell : grid.local_cells())
        for (const double value : cell.data->values) checksum += value;
    const auto cells = over_ranks(static_cast<double>(grid.get_cells().size()));
    const auto all_ghosts = over_ranks(ghosts), weights = over_ranks(ghost_weight);
    const double percent = 100 * over_ranks(moved)[0] / cells[0] / (steps - 1);
    const double sum = over_ranks(checksum)[0];
    if (rank == 0)
        std::printf("result %.0f %.6f %.0f %.0f %.0f %.0f %.4f %.12g\n", cells[0], percent,
                    all_ghosts[0], all_ghosts[1], weights[0], weights[1], imbalance, sum);
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    float version = 0;
    if (argc == 3 && Zoltan_Initialize(argc, argv, &version) == ZOLTAN_OK)
        run(argv[1], std::atoi(argv[2]));
    MPI_Finalize();
}
