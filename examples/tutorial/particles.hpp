// A column of water that collapses: positions of particles, a flow, and pairs within a radius.
#pragma once

#include <cstddef>
#include <vector>

constexpr int num_steps = 40;
constexpr double radius = 0.045;
constexpr double travel = 0.05;  // more than a particle moves in a step
constexpr double width = 1.5;    // of the tank, from x = 0

// Returns x and y of one particle after the other: 30 x 60 particles in the left of the tank.
inline std::vector<double> column_of_water() {
    std::vector<double> positions;
    for (int i = 0; i < 30; ++i) {
        for (int j = 0; j < 60; ++j) {
            positions.push_back((i + 0.5) / 60);
            positions.push_back((j + 0.5) / 60);
        }
    }
    return positions;
}

// Moves the particles for a step: down, and to the right.
inline void move(std::vector<double>& positions) {
    for (std::size_t i = 0; i < positions.size(); i += 2) {
        positions[i] *= 1.025;
        positions[i + 1] *= 0.975;
    }
}

// Counts for each of `own` the particles of `all` within the radius. This stands for the forces of
// a real code. A particle in both lists meets itself.
inline double count_pairs(const std::vector<double>& own, const std::vector<double>& all) {
    double pairs = 0;
    for (std::size_t i = 0; i < own.size(); i += 2) {
        for (std::size_t j = 0; j < all.size(); j += 2) {
            const double dx = own[i] - all[j];
            const double dy = own[i + 1] - all[j + 1];
            if (dx * dx + dy * dy <= radius * radius) ++pairs;
        }
    }
    return pairs;
}
