#include "support.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mpm::test {
namespace {

constexpr double length = 25, modulus = 100;

double mean_velocity(const Simulation& simulation) {
    const auto mass = simulation.particles()["mass"];
    const auto velocity = simulation.particles()["velocity_x"];
    return summed(simulation, MPI_COMM_WORLD,
                  [&](std::size_t p) { return mass[p] * velocity[p]; }) /
           length;
}

/// The columns of all points that make its energy.
struct State {
    explicit State(const Simulation& simulation)
        : mass(gathered(simulation, "mass", MPI_COMM_WORLD)),
          velocity(gathered(simulation, "velocity_x", MPI_COMM_WORLD)),
          stress(gathered(simulation, "stress_xx", MPI_COMM_WORLD)) {}

    std::vector<double> mass, velocity, stress;
};

/// The energy at the time of the stresses of a state, half a step after its velocities and half a
/// step before those of the next. The stress is E times the logarithmic strain e, so what stretches
/// a length of 1 has stored E ((e - 1) exp(e) + 1).
double energy_between(const State& state, const State& next) {
    double energy = 0;
    for (std::size_t p = 0; p < state.mass.size(); ++p) {
        const double strain = state.stress[p] / modulus;
        energy += state.mass[p] * (state.velocity[p] * next.velocity[p] / 2 +
                                   modulus * ((strain - 1) * std::exp(strain) + 1));
    }
    return energy;
}

TEST(AxialBar, vibrates_with_the_analytic_velocity_period_and_energy) {
    Simulation simulation(axial_bar(), MPI_COMM_WORLD);
    std::vector<double> zeros;
    double before = mean_velocity(simulation);
    State state(simulation);
    while (simulation.time() < 20) {
        const double start = simulation.time();
        simulation.step();
        const double now = mean_velocity(simulation);
        if ((before > 0) != (now > 0))
            zeros.push_back(start + (simulation.time() - start) * before / (before - now));
        before = now;
        EXPECT_NEAR(now, 0.0636620 * std::cos(0.6283185 * simulation.time()), 0.01 * 0.0636620);
        const State next(simulation);
        // That of the mode: density * amplitude^2 * L / 4.
        EXPECT_NEAR(energy_between(state, next), 0.0625, 0.001 * 0.0625);
        state = next;
    }
    ASSERT_EQ(zeros.size(), 4u);
    EXPECT_NEAR(zeros[2] - zeros[0], 10, 0.01);
    EXPECT_NEAR(zeros[3] - zeros[1], 10, 0.01);
}

}  // namespace
}  // namespace mpm::test
