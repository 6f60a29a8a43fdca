// Results that do not depend on the time step.
#include "variations.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

/// Where a scene has come to.
struct End {
    double energy;  ///< kinetic and elastic
    Vector way{};   ///< of the centre
    double front;   ///< behind which 95 % of the points are; single grains lie beyond
};

End end_of(Scene scene, double end_time, double courant_number) {
    scene.courant_number = courant_number;
    Simulation simulation(scene, MPI_COMM_WORLD);
    const Vector start = simulation.totals().center;
    while (simulation.time() < end_time) simulation.step();
    const Totals totals = simulation.totals();
    End end{totals.kinetic_energy + totals.strain_energy, {}, 0};
    const double late = simulation.time() - end_time;
    for (std::size_t a = 0; a < 2; ++a)
        end.way[a] = totals.center[a] - start[a] - totals.momentum[a] / totals.mass * late;
    std::vector<double> x = gathered(simulation, "x", MPI_COMM_WORLD);
    const auto front = x.begin() + std::ssize(x) * 95 / 100;
    std::ranges::nth_element(x, front);
    end.front = *front;
    return end;
}

/// Changes no way and front by more than a fiftieth, nor energy where it is kept.
void expect_same_at_any_step(const Scene& scene, double end_time, bool keeps_energy) {
    const End coarse = end_of(scene, end_time, scene.courant_number);
    for (const double courant_number : {0.1, 0.025}) {
        SCOPED_TRACE(courant_number);
        const End fine = end_of(scene, end_time, courant_number);
        const double way = std::hypot(fine.way[0], fine.way[1]);
        for (std::size_t a = 0; a < 2; ++a)
            EXPECT_NEAR(coarse.way[a], fine.way[a], 0.02 * way + 1e-9);
        EXPECT_NEAR(coarse.front, fine.front, 0.02 * fine.front);
        if (keeps_energy) {
            EXPECT_NEAR(coarse.energy, fine.energy, 0.02 * fine.energy);
        }
    }
}

struct Case {
    std::string scene;
    double cell_size, end_time;
};

class TimeStep : public testing::TestWithParam<Case> {};

TEST_P(TimeStep, changes_no_result_by_more_than_a_fiftieth) {
    const auto& [scene, cell_size, end_time] = GetParam();
    expect_same_at_any_step(shipped(scene, cell_size), end_time,
                            scene == "elastic_structure" || scene == "axial_bar");
}

INSTANTIATE_TEST_SUITE_P(Shipped, TimeStep,
                         testing::Values(Case{"granular_column", 0.2, 1},
                                         Case{"elastic_structure", 0.125, 0.75},
                                         Case{"axial_bar", 1, 2.5}, Case{"incline_block", 0.5, 2},
                                         Case{"dam_break", 0.2, 0.8},
                                         Case{"submarine_slide", 5, 4}),
                         [](const auto& tested) { return tested.param.scene; });

}  // namespace
}  // namespace mpm::test
