// Writes the state of a run to a file, from which the same or another number of ranks can continue.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

// The state of a run between two steps. If it has no cuts, it must first be divided among the
// ranks.
struct Run {
    int step = 0;
    int rebalances = 0;
    double heaviest = 0;  // largest load of a rank, summed over the steps
    double total = 0;
    std::vector<std::byte> controller{};
    std::vector<std::byte> model{};
    std::vector<std::byte> cuts{};
    std::vector<double> positions{};
    std::vector<double> rows{};  // of each particle: 1, its neighbours
};

// Returns the values of all ranks on rank 0, in the order of the ranks.
inline std::vector<double> gathered(const std::vector<double>& mine, MPI_Comm comm) {
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    const int count = static_cast<int>(mine.size());
    std::vector<int> counts(static_cast<std::size_t>(num_ranks));
    std::vector<int> begins(counts.size() + 1);
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
    for (std::size_t k = 0; k < counts.size(); ++k) begins[k + 1] = begins[k] + counts[k];
    std::vector<double> all(rank == 0 ? static_cast<std::size_t>(begins.back()) : 0);
    MPI_Gatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), begins.data(),
                MPI_DOUBLE, 0, comm);
    return all;
}

// Writes a record: the number of its values, then the values.
template <class Value>
void put(std::ofstream& file, const std::vector<Value>& values) {
    const std::uint64_t length = values.size();
    file.write(reinterpret_cast<const char*>(&length), sizeof length);
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(length * sizeof(Value)));
}

template <class Value>
std::vector<Value> next_of(std::ifstream& file) {
    std::uint64_t length = 0;
    file.read(reinterpret_cast<char*>(&length), sizeof length);
    std::vector<Value> values(length);
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(length * sizeof(Value)));
    return values;
}

// Rank 0 writes the particles of all ranks, and the bytes of save(), which every rank has.
inline void write_run(const std::string& path, const Run& run, MPI_Comm comm) {
    const std::vector<double> sizes = gathered({static_cast<double>(run.rows.size())}, comm);
    const std::vector<double> positions = gathered(run.positions, comm);
    const std::vector<double> rows = gathered(run.rows, comm);
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    if (rank != 0) return;
    std::ofstream file(path, std::ios::binary);
    put<double>(file, {1.0 * run.step, 1.0 * run.rebalances, run.heaviest, run.total});
    put(file, run.controller);
    put(file, run.model);
    put(file, run.cuts);
    put(file, sizes);
    put(file, positions);
    put(file, rows);
}

// Every rank reads the file. If the number of ranks is that of the file, each keeps its own
// particles. Otherwise each takes an equal share, and the cuts are dropped.
inline Run read_run(const std::string& path, MPI_Comm comm) {
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    std::ifstream file(path, std::ios::binary);
    const auto numbers = next_of<double>(file);
    Run run{static_cast<int>(numbers.at(0)), static_cast<int>(numbers.at(1)), numbers.at(2),
            numbers.at(3)};
    run.controller = next_of<std::byte>(file);
    run.model = next_of<std::byte>(file);
    run.cuts = next_of<std::byte>(file);
    const auto sizes = next_of<double>(file);
    const auto positions = next_of<double>(file);
    const auto rows = next_of<double>(file);
    const auto count = std::ssize(rows) / 2;
    std::ptrdiff_t begin = count * rank / num_ranks * 2;
    std::ptrdiff_t end = count * (rank + 1) / num_ranks * 2;
    if (std::ssize(sizes) == num_ranks) {
        begin = static_cast<std::ptrdiff_t>(std::accumulate(&sizes[0], &sizes[0] + rank, 0.0));
        end = begin + static_cast<std::ptrdiff_t>(sizes[static_cast<std::size_t>(rank)]);
    } else {
        run.cuts.clear();
    }
    run.positions.assign(positions.begin() + begin, positions.begin() + end);
    run.rows.assign(rows.begin() + begin, rows.begin() + end);
    return run;
}
