#include "scene/scene_reports.hpp"

#include "scene_file/scene_file_mpi.hpp"
#include "support.hpp"
#include "words.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace mpm::test {
namespace {

/// A scene of 4 x 4 m in cells of 0.5 m with blocks of these shapes, each a body of its own.
std::string blocks(const std::vector<std::string>& shapes, const std::string& effects = "") {
    std::string text =
        "scene:\n  dimension: 2\n  end_time: 1\n  domain:\n    lower: [0, 0]\n    cells: [8, 8]\n"
        "    cell_size: 0.5\n  walls:\n    bottom: fixed\n  materials:\n    rubber:\n"
        "      model: elastic\n      density: 1000\n      youngs_modulus: 1e6\n"
        "      poissons_ratio: 0.3\n  bodies:\n";
    for (std::size_t k = 0; k < shapes.size(); ++k)
        text += "    block" + std::to_string(k) +
                ":\n      material: rubber\n      points_per_cell: [2, 2]\n      shapes:\n" +
                "        all: {" + shapes[k] + "}\n";
    return text + effects;
}

std::string box(const std::string& lower, const std::string& upper) {
    return "shape: box, lower: [" + lower + "], upper: [" + upper + "]";
}

Scene scene_of(const std::string& text) {
    return parse_scene(text, "a.yaml").scene;
}

std::string error_of(const std::string& text) {
    try {
        const Simulation simulation(scene_of(text), MPI_COMM_WORLD);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

// Points lie at odd multiples of 0.125 m and stand for 62.5 kg each.
TEST(SceneReports, tell_the_mass_of_points_and_shapes) {
    const auto reports =
        report_on_bodies(scene_of(blocks({box("0, 0", "1, 1"), box("2, 0", "3.1, 1"),
                                          "shape: half_space, point: [0, 3], normal: [0, -1]"})));
    ASSERT_EQ(reports.size(), 3u);
    EXPECT_EQ(reports[0].num_points, 16);
    EXPECT_DOUBLE_EQ(reports[0].mass, 1000);
    EXPECT_NEAR(reports[0].asked_mass, 1000, 1e-6);
    EXPECT_EQ(reports[0].warning, "");
    EXPECT_DOUBLE_EQ(reports[1].mass, 1000);
    EXPECT_NEAR(reports[1].asked_mass, 1100, 1e-6);
    expect_names(reports[1].warning, {"bodies / block1", "cut the lattice", "0.25 m along x"});
    EXPECT_DOUBLE_EQ(reports[2].mass, 4000);
    EXPECT_NEAR(reports[2].asked_mass, 4000, 12);
    EXPECT_EQ(reports[2].warning, "");
}

TEST(SceneReports, warn_of_what_lies_outside_the_grid) {
    const auto reports = report_on_bodies(
        scene_of(blocks({box("3, 0", "5, 1"), "shape: ball, centre: [0, 3], radius: 0.5"})));
    EXPECT_NEAR(reports[0].asked_mass, 2 * reports[0].mass, 1e-6);
    expect_names(reports[0].warning, {"block0", "up to x = 5 m", "domain to 4 m", "larger"});
    EXPECT_NEAR(reports[1].asked_mass, 1000 * std::numbers::pi / 4, 3);
    expect_names(reports[1].warning, {"block1", "down to x = -0.5 m", "domain to 0 m"});
}

TEST(SceneReports, of_combined_shapes_ask_for_what_is_left) {
    const std::string two = blocks(
        {box("0, 0", "2, 2") + "}\n        hole: {operation: subtract, " + box("0, 0", "1, 1") +
         "}\n        half: {operation: intersect, " + box("0, 0", "2, 1.5")});
    const auto reports = report_on_bodies(scene_of(two));
    EXPECT_NEAR(reports[0].asked_mass, 2000, 10);
    EXPECT_DOUBLE_EQ(reports[0].mass, 2000);
}

TEST(SceneReports, warn_of_a_courant_number_beyond_the_stable_one) {
    Scene scene = scene_of(blocks({box("0, 0", "1, 1")}));
    EXPECT_TRUE(scene_warnings(scene).empty());
    scene.courant_number = 1;
    expect_names(scene_warnings(scene).front(), {"method", "courant_number 1 ", "lower it"});
}

TEST(SceneReports, warn_of_numbers_that_look_as_if_in_other_units) {
    Scene scene = scene_of(blocks({box("0, 0", "1, 1")}));
    scene.effects = {gravity_effect(9.81)};
    scene.materials = {{"rubber",
                        "drucker_prager",
                        {{"density", 2.0},
                         {"youngs_modulus", 10.0},
                         {"poissons_ratio", 0.3},
                         {"cohesion", 0.0},
                         {"friction_angle", 0.52}}}};
    scene.probes = {{"far", {2, 4, 0}}};
    const auto warnings = scene_warnings(scene);
    ASSERT_EQ(warnings.size(), 5u);
    for (const auto& [k, word] :
         {std::pair(0, "kg/m^3"), std::pair(1, "in Pa"), std::pair(2, "in degrees"),
          std::pair(3, "locking_cure"), std::pair(4, "probes / far")})
        expect_names(warnings[static_cast<std::size_t>(k)], {word});
}

// 0.01 * 1000 kg/m^3 * sqrt(1e6 * 0.7 / (1.3 * 0.4) / 1000) m/s * 0.5 m
TEST(SceneReports, tell_the_viscosity_of_what_is_read_back_from_the_grid) {
    Scene scene = scene_of(blocks({box("0, 0", "1, 1")}));
    EXPECT_TRUE(damping_notes(scene).empty());
    scene.flip_fraction = 0.99;
    expect_names(damping_notes(scene).front(), {"flip_fraction 0.99", "183 Pa s in rubber"});
}

// A frame: what is called stable gains no energy.
TEST(SceneReports, call_stable_what_gains_no_energy) {
    for (const auto shape : {ShapeFunction::linear, ShapeFunction::quadratic})
        for (const auto transfer : {Transfer::flip, Transfer::apic}) {
            Scene scene = read_scene(RRCB_SCENES "/elastic_structure.yaml", MPI_COMM_WORLD).scene;
            resize_cells(scene, 0.25);
            scene.shape_function = shape;
            scene.transfer = transfer;
            scene.courant_number = stable_courant_number(scene);
            Simulation simulation(scene, MPI_COMM_WORLD);
            const double start = simulation.totals().kinetic_energy;
            while (simulation.time() < 1) simulation.step();
            const Totals end = simulation.totals();
            EXPECT_LT(end.kinetic_energy + end.strain_energy, 1.05 * start)
                << static_cast<int>(shape) << static_cast<int>(transfer);
        }
}

TEST(Scene, with_bodies_that_cannot_be_meant_is_refused_on_all_ranks) {
    expect_names(error_of(blocks({box("0, 0", "2, 2"), box("1, 1", "3, 3")})),
                 {"bodies / block0", "overlaps the body 'block1'", "x = 1.125", "subtract"});
    EXPECT_EQ(error_of(blocks({box("0, 0", "2, 2"), box("2, 0", "3, 3")})), "");
    expect_names(error_of(blocks({box("0, 0", "2, 2"), box("5, 0", "6, 3")})),
                 {"bodies / block1", "no point", "in the domain"});
    expect_names(error_of(blocks({box("0, 2", "2, 0")})),
                 {"bodies / block0 / shapes / all", "'upper'", "above 'lower' along y"});
    const std::string gravity = "  effects:\n    gravity:\n      acceleration: [0, -10]\n";
    expect_names(
        error_of(blocks({box("0, 0", "2, 2")}, gravity + "      ramp: 1\n    geostatic: {}\n")),
        {"effects / geostatic", "'ramp'"});
    EXPECT_EQ(error_of(blocks({box("0, 0", "2, 2")}, gravity + "    geostatic: {}\n")), "");
}

}  // namespace
}  // namespace mpm::test
