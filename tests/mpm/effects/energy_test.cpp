#include "scene_file/scene_file_mpi.hpp"
#include "support.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace mpm::test {
namespace {

/// A shipped scene in a small size, and the share of its energy that may be unaccounted for.
struct Account {
    std::string scene;
    double cell_size, end_time, limit;
};

// What yields closes to 1 %, what is elastic to 0.1 %, rubbed and dragged or not.
const std::vector<Account> accounts{
    {"slope", 5, 4, 0.01},
    {"submarine_slide", 2.5, 4, 0.01},
    {"torpedo_anchor", 0.375, 0.2, 0.01},
    {"anchor_plate", 0.5, 0.4, 0.01},
    {"granular_column", 0.2, 1, 0.01},
    {"vertical_cut", 0.5, 1, 0.01},
    {"dam_break", 0.1, 1.6, 0.01},
    {"elastic_structure", 0.25, 1, 0.001},
    {"axial_bar", 1, 5, 0.001},
    {"two_disks", 0.05, 0.2, 0.001},
    {"hydrostatic_column", 0.0125, 0.05, 0.001},
    {"incline_block", 0.25, 2, 0.001},
    {"falling_body", 0.25, 1, 0.001},
};

/// Energies at one time, J.
struct Energies {
    double kinetic, strain, potential, dissipated;

    explicit Energies(const Totals& totals)
        : kinetic(totals.kinetic_energy),
          strain(totals.strain_energy),
          potential(totals.potential_energy),
          dissipated(totals.dissipated_energy.value() + totals.transfer_loss.value()) {}

    double sum() const { return kinetic + strain + potential + dissipated; }
    /// The largest energy that has changed its form since the start, or is in motion.
    double exchanged(const Energies& start) const {
        return std::max({kinetic, std::abs(strain - start.strain),
                         std::abs(potential - start.potential),
                         std::abs(dissipated - start.dissipated)});
    }
};

class SceneEnergy : public testing::TestWithParam<Account> {};

TEST_P(SceneEnergy, is_accounted_for) {
    const Account& account = GetParam();
    Scene scene = read_scene(RRCB_SCENES "/" + account.scene + ".yaml", MPI_COMM_WORLD).scene;
    resize_cells(scene, account.cell_size);
    if (find_effect(scene, "energy_audit") == nullptr)
        scene.effects.push_back({"energy_audit", {}});
    Simulation simulation(scene, MPI_COMM_WORLD);
    const Energies start(simulation.totals());
    double scale = start.kinetic, gap = 0;
    while (simulation.time() < account.end_time) {
        for (int step = 0; step < 20; ++step) simulation.step();
        Energies now(simulation.totals());
        // Velocities, and what they have lost, are half a step older than positions and stresses.
        simulation.step();
        const Energies next(simulation.totals());
        now.kinetic = 0.5 * (now.kinetic + next.kinetic);
        now.dissipated = 0.5 * (now.dissipated + next.dissipated);
        scale = std::max(scale, now.exchanged(start));
        gap = std::max(gap, std::abs(now.sum() - start.sum()));
    }
    EXPECT_LT(gap, account.limit * scale);
    RecordProperty("gap_by_scale", std::to_string(gap / scale));
}

INSTANTIATE_TEST_SUITE_P(Shipped, SceneEnergy, testing::ValuesIn(accounts),
                         [](const auto& account) { return account.param.scene; });

// A transfer that forgets (PIC) is told from friction and yielding, which elastic disks have none
// of.
TEST(TransferLoss, is_no_dissipation) {
    Scene scene = read_scene(RRCB_SCENES "/two_disks.yaml", MPI_COMM_WORLD).scene;
    scene.flip_fraction = 0;
    if (find_effect(scene, "energy_audit") == nullptr)
        scene.effects.push_back({"energy_audit", {}});
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double start = simulation.totals().kinetic_energy;
    while (simulation.time() < scene.end_time) simulation.step();
    const Totals end = simulation.totals();
    EXPECT_GT(end.transfer_loss.value(), 0.3 * start);
    EXPECT_EQ(end.dissipated_energy.value(), 0);
    EXPECT_NEAR(total_energy(simulation), start, 0.005 * start);
}

// A least mass of nodes that quadratic functions cannot bear makes a beam explode.
TEST(TransferLoss, is_below_zero_where_a_run_is_unstable) {
    Scene scene = read_scene(RRCB_SCENES "/elastic_structure.yaml", MPI_COMM_WORLD).scene;
    scene.transfer = Transfer::apic;
    scene.flip_fraction = 0;
    scene.courant_number = 0.5;
    scene.least_node_mass = 0.125;
    Simulation simulation(scene, MPI_COMM_WORLD);
    const double start = simulation.totals().kinetic_energy;
    double energy = start;
    while (energy < 5 * start && simulation.time() < 2) {
        simulation.step();
        const Totals now = simulation.totals();
        energy = now.kinetic_energy + now.strain_energy;
    }
    EXPECT_GE(energy, 5 * start);
    EXPECT_LT(simulation.totals().transfer_loss.value(), -2 * start);
    EXPECT_NEAR(simulation.totals().dissipated_energy.value(), 0, 0.1 * start);
}

TEST(SceneEnergies, leave_no_shipped_scene_out) {
    std::set<std::string> shipped, checked;
    for (const auto& entry : std::filesystem::directory_iterator(RRCB_SCENES))
        shipped.insert(entry.path().stem().string());
    for (const Account& account : accounts) checked.insert(account.scene);
    EXPECT_EQ(shipped, checked);
}

}  // namespace
}  // namespace mpm::test
