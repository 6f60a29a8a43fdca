// Step 6: restart on other ranks. A first run stops half-way and writes a file, a second goes on.
//
//     mpirun -n 4 step6 particles.dat && mpirun -n 3 step6 particles.dat
#include "gathered.hpp"
#include "loads.hpp"
#include "particles.hpp"

#include <rrcb/rrcb.hpp>

#include <algorithm>
#include <fstream>
#include <optional>

// Step and pairs so far, then positions, as rank 0 writes and reads them. No file: the beginning.
std::vector<double> read(const char* name) {
    std::vector<double> values{0, 0};
    std::ifstream file(name, std::ios::binary | std::ios::ate);
    if (!file) {
        const std::vector<double> positions = column_of_water();
        values.insert(values.end(), positions.begin(), positions.end());
        return values;
    }
    values.resize(static_cast<std::size_t>(file.tellg()) / sizeof(double));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(double)));
    return values;
}

void write(const char* name, const std::vector<double>& values) {
    std::ofstream file(name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(double)));
}

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    const MPI_Comm comm = MPI_COMM_WORLD;
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    const char* name = argc > 1 ? argv[1] : "particles.dat";
    std::vector<double> own = rank == 0 ? read(name) : std::vector<double>{};
    double done[2] = {};  // steps and pairs
    if (rank == 0) {
        std::copy_n(own.begin(), 2, done);
        own.erase(own.begin(), own.begin() + 2);
    }
    MPI_Bcast(done, 2, MPI_DOUBLE, 0, comm);
    const int first = static_cast<int>(done[0]);
    const int last = first == 0 ? num_steps / 2 : num_steps;
    Loads loads{.pairs = done[1]};
    {
        rrcb::Controller controller(comm);  // begins anew, as the ranks may be others
        rrcb::Cuts cuts;
        std::optional<rrcb::Neighbours> neighbours;
        std::vector<double> ghosts;
        for (int step = first; step < last; ++step) {
            if (step == first || controller.due()) {
                const rrcb::Points points(own, 2);
                const rrcb::Balance balance = rrcb::balance(points, comm, {}, cuts);
                own = rrcb::transfer(rrcb::plan(balance, comm), rrcb::column(own, 2), comm);
                cuts = balance.cuts;
                neighbours = rrcb::Neighbours(cuts, comm, {.cutoff = radius, .travel = travel});
                controller.rebalanced({.cost = 2000, .report = &balance.report});
            } else {
                neighbours->migrate(rrcb::column(own, 2));
            }
            neighbours->find_ghosts(rrcb::column(own, 2));
            neighbours->fetch(rrcb::ghosts_of(ghosts), rrcb::column(own, 2));
            const double pairs = count_pairs(own, own) + count_pairs(own, ghosts);
            move(own);
            controller.step({.load = pairs});
            loads.add(pairs, comm);
        }
    }
    std::vector<double> values{static_cast<double>(last), loads.pairs};
    const std::vector<double> positions = gathered(own, comm);
    values.insert(values.end(), positions.begin(), positions.end());
    if (rank == 0) {
        write(name, values);
        std::printf("%.0f pairs after %d steps\n", loads.pairs, last);
    }
    MPI_Finalize();
}

// Output of the second run, on 3 ranks:
// 1605164 pairs after 40 steps
