// Particles of a fluid in a unit square, and the interaction of two of them.
#pragma once

#include <mpi.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

constexpr double reach = 0.06;  // radius of the kernel
constexpr double mass = 1.0 / 1600;
constexpr double pi = 3.14159265358979323846;

struct Particles {
    std::vector<double> positions{};
    std::vector<double> velocities{};
    std::vector<double> densities{};
    std::vector<int> numbers{};
};

// Returns this rank's share of 40 x 40 moving particles, which are densest in the middle.
inline Particles share_of(MPI_Comm comm) {
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    Particles own;
    for (int k = 1600 * rank / num_ranks; k < 1600 * (rank + 1) / num_ranks; ++k) {
        own.densities.push_back(1);
        for (const double x : {(k / 40 + 0.5) / 40, (k % 40 + 0.5) / 40}) {
            own.positions.push_back(x + 0.1 * std::sin(2 * pi * x));
            own.velocities.push_back(1);
            own.densities.back() /= 1 + 0.2 * pi * std::cos(2 * pi * x);
        }
        own.numbers.push_back(k);
    }
    return own;
}

// Returns the contribution to the density of a particle at this distance.
inline double kernel(double distance) {
    return mass * 4 / (pi * reach * reach) * std::pow(1 - std::pow(distance / reach, 2), 3);
}

// Returns the acceleration of a particle by another one, divided by their distance.
inline double push(double distance, double density, double other_density) {
    const double slope =
        -24 / (pi * std::pow(reach, 4)) * std::pow(1 - std::pow(distance / reach, 2), 2);
    const auto pressure = [](double rho) { return (rho - 0.5) / (rho * rho); };
    return -mass * slope * (pressure(density) + pressure(other_density));
}

struct Pair {
    std::size_t i;
    std::size_t j;
    double distance;
};

// Returns the pairs i < j within reach with i among the first `count`. Searches by cells.
inline std::vector<Pair> pairs_among(const std::vector<double>& at, std::size_t count) {
    using Cell = std::pair<long, long>;
    std::map<Cell, std::vector<std::size_t>> cells;
    const auto cell_of = [&](std::size_t i) {
        return Cell(std::lround(at[2 * i] / reach), std::lround(at[2 * i + 1] / reach));
    };
    for (std::size_t i = 0; 2 * i < at.size(); ++i) cells[cell_of(i)].push_back(i);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 9; ++k) {
            const Cell cell(cell_of(i).first + k / 3 - 1, cell_of(i).second + k % 3 - 1);
            for (const std::size_t j : cells[cell]) {
                const double distance =
                    std::hypot(at[2 * i] - at[2 * j], at[2 * i + 1] - at[2 * j + 1]);
                if (i < j && distance < reach) pairs.push_back({i, j, distance});
            }
        }
    }
    return pairs;
}

// Returns the local values followed by those of ghosts.
template <class T>
std::vector<T> joined(std::vector<T> own, const std::vector<T>& ghosts) {
    own.insert(own.end(), ghosts.begin(), ghosts.end());
    return own;
}
