// The example beside brute force on one rank: all pairs of all particles at the nearest images.
#define main example_main
#include "sph/main.cpp"
#undef main

#include <gtest/gtest.h>

#include <array>

namespace {

/// Values of all particles by their numbers, on every rank.
std::vector<double> by_number(const std::vector<int>& numbers, const std::vector<double>& values,
                              std::size_t components) {
    std::vector<double> all(1600 * components);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        for (std::size_t a = 0; a < components; ++a)
            all[numbers[i] * components + a] += values[i * components + a];
    MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM,
                  MPI_COMM_WORLD);
    return all;
}

/// Distance to the nearest image along each axis.
std::array<double, 2> between(const Particles& all, std::size_t i, std::size_t j) {
    std::array<double, 2> x{};
    for (std::size_t a = 0; a < 2; ++a) {
        const double apart = all.positions[2 * i + a] - all.positions[2 * j + a];
        x[a] = apart - std::round(apart);
    }
    return x;
}

/// Calls a function for each pair within reach.
template <class Visit>
void for_each_pair(const Particles& all, Visit visit) {
    for (std::size_t i = 0; i < all.numbers.size(); ++i)
        for (std::size_t j = i + 1; j < all.numbers.size(); ++j) {
            const std::array<double, 2> x = between(all, i, j);
            const double distance = std::hypot(x[0], x[1]);
            if (distance < reach) visit(i, j, distance, x);
        }
}

void step_by_brute_force(Particles& all) {
    all.densities.assign(all.numbers.size(), kernel(0));
    for_each_pair(all, [&](std::size_t i, std::size_t j, double distance, const auto&) {
        all.densities[i] += kernel(distance);
        all.densities[j] += kernel(distance);
    });
    std::vector<double> forces(all.positions.size());
    for_each_pair(all, [&](std::size_t i, std::size_t j, double distance, const auto& x) {
        const double force = push(distance, all.densities[i], all.densities[j]);
        for (std::size_t a = 0; a < 2; ++a) {
            forces[2 * i + a] += force * x[a];
            forces[2 * j + a] -= force * x[a];
        }
    });
    for (std::size_t k = 0; k < forces.size(); ++k) {
        all.velocities[k] += time_step * forces[k];
        all.positions[k] += time_step * all.velocities[k];
    }
}

TEST(Sph, densities_are_those_of_brute_force_and_momentum_is_conserved) {
    constexpr int num_steps = 40;
    Particles expected = share_of(MPI_COMM_SELF);
    for (int step = 0; step < num_steps; ++step) step_by_brute_force(expected);
    const Particles own = simulate(share_of(MPI_COMM_WORLD), num_steps, MPI_COMM_WORLD);
    const std::vector<double> densities = by_number(own.numbers, own.densities, 1);
    const std::vector<double> velocities = by_number(own.numbers, own.velocities, 2);
    std::array<double, 2> momentum{};
    for (std::size_t i = 0; i < densities.size(); ++i) {
        EXPECT_NEAR(densities[i], expected.densities[i], 1e-11 * expected.densities[i]);
        for (std::size_t a = 0; a < 2; ++a) {
            EXPECT_NEAR(velocities[2 * i + a], expected.velocities[2 * i + a], 1e-11);
            momentum[a] += mass * velocities[2 * i + a];
        }
    }
    EXPECT_NEAR(momentum[0], 1, 1e-13);
    EXPECT_NEAR(momentum[1], 1, 1e-13);
}

}  // namespace
