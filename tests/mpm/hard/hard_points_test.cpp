// Points on the faces of cells, points by themselves, ranks that hold none, a rebalance at every
// step.
#include "support.hpp"

#include <gtest/gtest.h>

namespace mpm::test {
namespace {

constexpr ShapeFunction all_shapes[] = {ShapeFunction::linear, ShapeFunction::quadratic};
constexpr double spacing = 0.25;

/// Points of wave speed 1 that move by a quarter of a cell in a step of Courant number 0.5: they
/// start at quarters of their cells, and half of them are on a face after every other step.
Scene moving_block(ShapeFunction shape, double speed) {
    const Body block{.contains = box_region({{1, 1}, {2, 2}}),
                     .material = "rubber",
                     .velocity = velocity_field({.constant = {speed, 0}})};
    return {.name = "moving block",
            .grid = {.lower = {0, 0}, .spacing = spacing, .num_cells = {24, 12}},
            .materials = {elastic_material("rubber", 1, 1, 0)},
            .bodies = {block},
            .shape_function = shape,
            .courant_number = 0.5};
}

/// A single point, falling; the lattice of its body has so many points along a cell.
Scene falling_point(ShapeFunction shape, int points_along_a_cell) {
    const double offset = spacing * (5 + 0.5 / points_along_a_cell);
    const Body point{.contains = ball_region({offset, 4 + offset}, 0.01),
                     .points_per_cell = {points_along_a_cell, points_along_a_cell, 1},
                     .material = "rubber",
                     .velocity = velocity_field({.constant = {0.3, 0}})};
    return {.name = "falling point",
            .grid = {.lower = {0, 0}, .spacing = spacing, .num_cells = {24, 24}},
            .materials = {elastic_material("rubber", 1, 1e3, 0.3)},
            .bodies = {point},
            .effects = {gravity_effect(9.81)},
            .shape_function = shape};
}

double largest_stress(const Simulation& simulation) {
    double largest = 0;
    for (const char* name : {"stress_xx", "stress_yy", "stress_zz", "stress_xy"})
        for (const double stress : simulation.particles()[name])
            largest = std::max(largest, std::abs(stress));
    return largest;
}

/// Distance of the point nearest to a face of its cell, in cells, over all ranks.
double least_distance_to_a_face(const Simulation& simulation) {
    double least = 1;
    for (const double x : simulation.particles()["x"])
        least = std::min(least, std::abs(std::remainder(x / spacing, 1)));
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    return least;
}

/// Cuts through faces of cells on which points lie, others at every step; most ranks have few
/// points or none.
void cut_on_faces(Simulation& simulation) {
    const auto step = simulation.step_count();
    std::vector<double> cuts;
    for (int k = 1; k < size_of(MPI_COMM_WORLD); ++k)
        cuts.push_back(spacing * static_cast<double>(step / 4 + 3 * k));
    simulation.rebalance([&](Positions, MPI_Comm) { return between_cuts(cuts, step % 2 == 0); });
}

TEST(HardPoints, a_hair_from_a_face_move_as_all_others) {
    for (const ShapeFunction shape : all_shapes) {
        for (const double hair : {0.0, -1e-15, 1e-15}) {
            SCOPED_TRACE(hair);
            // A step takes speed / (1 + speed) of the cell: half of a relative change stays.
            const double speed = 1 + 8 * hair;
            Simulation simulation(moving_block(shape, speed), MPI_COMM_WORLD);
            const double mass = simulation.totals().mass;
            while (simulation.step_count() < 40) {
                cut_on_faces(simulation);
                simulation.step();
                if (simulation.step_count() % 2 == 1) {
                    EXPECT_LT(least_distance_to_a_face(simulation), 1e-12);
                }
            }
            for (const double displacement : displacements_along(simulation, 0))
                EXPECT_NEAR(displacement, speed * simulation.time(), 1e-12);
            EXPECT_LT(largest_stress(simulation), 1e-11);
            const Totals end = simulation.totals();
            EXPECT_NEAR(end.momentum[0], speed * mass, 1e-12 * mass);
            EXPECT_NEAR(end.kinetic_energy, speed * speed * mass / 2, 1e-12 * mass);
        }
    }
}

/// On its way a point comes as near to nodes as steps allow, where its share of mass vanishes.
void expect_free_fall(const Scene& scene) {
    Simulation simulation(scene, MPI_COMM_WORLD);
    ASSERT_EQ(simulation.num_points(), 1);
    const Totals start = simulation.totals();
    double speed = 0;
    double fallen = 0;
    while (simulation.time() < 0.9) {
        speed += 9.81 * simulation.time_step();
        fallen += speed * simulation.time_step();
        cut_on_faces(simulation);
        simulation.step();
    }
    EXPECT_NEAR(fallen, 9.81 * 0.81 / 2, 0.05);
    for (const double displacement : displacements_along(simulation, 1))
        EXPECT_NEAR(displacement, -fallen, 1e-10);
    for (const double displacement : displacements_along(simulation, 0))
        EXPECT_NEAR(displacement, 0.3 * simulation.time(), 1e-10);
    const Totals end = simulation.totals();
    EXPECT_NEAR(end.kinetic_energy - start.kinetic_energy, end.mass * speed * speed / 2, 1e-9);
    EXPECT_NEAR(start.potential_energy - end.potential_energy, end.mass * 9.81 * fallen, 1e-9);
    // Light nodes are strained less by gravity than others, by a part of this weight.
    EXPECT_LT(largest_stress(simulation), 1 * 9.81 * spacing);
}

TEST(HardPoints, by_themselves_fall_freely_past_every_node) {
    for (const ShapeFunction shape : all_shapes)
        for (const int points_along_a_cell : {1, 2, 4}) {
            SCOPED_TRACE(points_along_a_cell);
            expect_free_fall(falling_point(shape, points_along_a_cell));
        }
}

}  // namespace
}  // namespace mpm::test
