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

TEST(SceneReports, warn_of_bodies_beyond_the_domain) {
    const auto warnings =
        scene_warnings(scene_of(blocks({box("3, 0", "5, 1"), box("-0.5, 2", "1, 3"),
                                        "shape: half_space, point: [0, 3], normal: [0, -1]"})));
    ASSERT_EQ(warnings.size(), 2u);
    expect_names(warnings[0], {"block0", "reaches to x = 5 m", "larger"});
    expect_names(warnings[1], {"block1", "reaches to x = -0.5 m"});
}

// Points at 0.125, 0.375, ... m of 0.0625 m^2: a box from 0.25 to 1.125 m has 3 x 3 of them, 562.5
// kg for 765.6 kg; a ball of radius 0.375 has 4 for 7.07. 4 x 4 points stand for what they should.
TEST(SceneReports, warn_of_points_that_weigh_more_or_less_than_their_body) {
    const auto warnings = scene_warnings(scene_of(
        blocks({box("0.25, 0.25", "1.125, 1.125"), box("2.125, 0.125", "3.125, 1.125"),
                "shape: ball, centre: [3, 3], radius: 0.375",
                "shape: polygon, corners: [[0.125, 2.125], [1.125, 2.125], [0.125, 3.125]]"})));
    ASSERT_EQ(warnings.size(), 3u);
    expect_names(warnings[0], {"block0", "562 kg", "766 kg", "midway between points"});
    expect_names(warnings[1], {"block2", "250 kg", "442 kg", "points_per_cell"});
    expect_names(warnings[2], {"block3", "625 kg", "500 kg"});
}

TEST(SceneReports, warn_of_no_body_of_a_shipped_scene) {
    for (const char* name : {"axial_bar", "dam_break", "elastic_structure", "granular_column",
                             "hydrostatic_column", "incline_block", "run_out", "slope",
                             "submarine_slide", "torpedo_anchor", "two_disks", "vertical_cut"})
        for (const std::string& warning : scene_warnings(
                 read_scene(std::string(RRCB_SCENES "/") + name + ".yaml", MPI_COMM_WORLD).scene))
            EXPECT_EQ(warning.find("bodies / "), std::string::npos) << name << ": " << warning;
}

TEST(SceneReports, warn_of_a_courant_number_beyond_the_stable_one) {
    Scene scene = scene_of(blocks({box("0, 0", "1, 1")}));
    EXPECT_TRUE(scene_warnings(scene).empty());
    scene.courant_number = 0.45;
    expect_names(scene_warnings(scene).front(), {"method", "courant_number 0.45 ", "lower it"});
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

/// Sand that begins at rest under its weight, with a ratio of lateral to vertical stress.
Scene resting(double lateral_ratio) {
    Scene scene = scene_of(blocks({box("0, 0", "1, 1")}));
    scene.effects = {gravity_effect(9.81),
                     {"geostatic", {{"lateral_ratio", lateral_ratio}}},
                     {"locking_cure", {}}};
    scene.materials = {soil_material("rubber", 1000, 0, 30)};
    return scene;
}

// (sqrt(3) - sin 30) / (sqrt(3) + 2 sin 30) = 0.451; Mohr-Coulomb's is 1/3.
TEST(SceneReports, warn_of_ground_that_yields_at_rest) {
    EXPECT_TRUE(scene_warnings(resting(0.452)).empty());
    const auto warnings = scene_warnings(resting(0.45));
    ASSERT_EQ(warnings.size(), 1u);
    expect_names(warnings.front(), {"geostatic", "lateral_ratio 0.45", "rubber", "0.451"});
}

TEST(Scene, that_contradicts_itself_is_refused) {
    const auto expect_scene_refused = [](const Scene& scene,
                                         const std::vector<std::string>& words) {
        expect_refused([&] { Simulation(scene, MPI_COMM_WORLD); }, words);
    };
    Scene scene = resting(1);
    scene.materials.push_back(elastic_material("stone", 2700, 1e6, 0.3));
    scene.bodies.push_back(scene.bodies.front());
    scene.bodies.back().material = "stone";
    scene.bodies.back().contains = box_region({{2, 0}, {3, 1}});
    scene.bodies.back().bounds = everywhere;
    expect_scene_refused(scene, {"effects / geostatic", "same density"});
    scene = resting(1);
    scene.effects.push_back({"buoyancy", {{"water_density", 1000.0}}});
    scene.effects.push_back({"penetrator",
                             {{"tip", std::vector<double>{2, 3}},
                              {"radius", 0.5},
                              {"length", 1.0},
                              {"mass", 1.0},
                              {"fluid_density", 1025.0}}});
    expect_scene_refused(scene, {"effects / buoyancy", "'water_density'", "other effects"});
    scene = resting(1);
    scene.probes = {{"two\nlines", {0.5, 0.5, 0}}};
    expect_scene_refused(scene, {"probe 'two", "one line"});
    scene = resting(1);
    scene.bodies.front().points_per_cell = {1000000, 1000000, 1};
    expect_scene_refused(scene, {"bodies / block0", "1e10", "points_per_cell"});
    expect_names(error_of(blocks({"shape: polygon, corners: [[0, 0], [2, 2], [2, 0], [0, 2]]"})),
                 {"'corners'", "two edges cross"});
    EXPECT_EQ(error_of(blocks({"shape: polygon, corners: [[0, 0], [2, 0], [2, 2], [1, 1]]"})), "");
}

// A frame: what is called stable gains no energy.
TEST(SceneReports, call_stable_what_gains_no_energy) {
    for (const auto shape : {ShapeFunction::linear, ShapeFunction::quadratic}) {
        Scene scene = read_scene(RRCB_SCENES "/elastic_structure.yaml", MPI_COMM_WORLD).scene;
        resize_cells(scene, 0.25);
        scene.shape_function = shape;
        scene.courant_number = stable_courant_number(scene);
        Simulation simulation(scene, MPI_COMM_WORLD);
        const double start = simulation.totals().kinetic_energy;
        while (simulation.time() < 1) simulation.step();
        const Totals end = simulation.totals();
        EXPECT_LT(end.kinetic_energy + end.strain_energy, 1.05 * start) << static_cast<int>(shape);
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
