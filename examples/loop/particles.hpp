// Particles in a unit square, which move to one side and meet their neighbours within a cut-off.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

constexpr double radius = 0.01;
constexpr double travel = 0.005;  // largest distance that move() moves a particle

// Returns this rank's strip of a unit square of 200 x 200 particles.
inline std::vector<double> strip_of(int rank, int num_ranks) {
    std::vector<double> positions;
    for (int i = 200 * rank / num_ranks; i < 200 * (rank + 1) / num_ranks; ++i) {
        for (int j = 0; j < 200; ++j) {
            positions.push_back((i + 0.5) / 200);
            positions.push_back((j + 0.5) / 200);
        }
    }
    return positions;
}

// Returns how many particles and ghosts are within the radius of each local particle, which counts
// as well.
inline std::vector<double> count_neighbours(const std::vector<double>& own,
                                            const std::vector<double>& ghosts) {
    using Cell = std::pair<std::int64_t, std::int64_t>;
    const auto cell_of = [](const double* x) {
        return Cell(std::llround(std::floor(x[0] / radius)),
                    std::llround(std::floor(x[1] / radius)));
    };
    std::map<Cell, std::vector<const double*>> cells;
    for (const std::vector<double>* positions : {&own, &ghosts}) {
        for (std::size_t i = 0; i < positions->size(); i += 2)
            cells[cell_of(&(*positions)[i])].push_back(&(*positions)[i]);
    }
    std::vector<double> counts;
    for (std::size_t i = 0; i < own.size(); i += 2) {
        const double* here = &own[i];
        const Cell centre = cell_of(here);
        double count = 0;
        for (std::int64_t k = 0; k < 9; ++k) {
            const auto cell = cells.find({centre.first + k / 3 - 1, centre.second + k % 3 - 1});
            if (cell == cells.end()) continue;
            for (const double* there : cell->second)
                count += std::hypot(here[0] - there[0], here[1] - there[1]) <= radius ? 1 : 0;
        }
        counts.push_back(count);
    }
    return counts;
}

// Moves all particles towards the wall at x = 0, where they become dense.
inline void move(std::vector<double>& positions) {
    for (std::size_t i = 0; i < positions.size(); i += 2)
        positions[i] -= 0.02 * positions[i] * (1 - positions[i]);
}

inline double sum_of(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum;
}
