#include "scene/lattice.hpp"
#include "scene_file/expression.hpp"
#include "scene_file/scene_file_mpi.hpp"
#include "support.hpp"
#include "words.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace mpm::test {
namespace {

const std::string slope_path = RRCB_SCENES "/slope.yaml";

std::string text_of(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// The error of the slope's file with one piece of text exchanged.
std::string error_with(const std::string& from, const std::string& to) {
    std::string text = text_of(slope_path);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
        parse_scene(text, SceneFormat::yaml, "a.yaml");
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(SceneFile, of_the_slope_is_the_slope_to_the_bit) {
    Simulation by_file(read_scene(slope_path, MPI_COMM_WORLD).scene, MPI_COMM_WORLD);
    Simulation by_code(slope_scene(), MPI_COMM_WORLD);
    for (int step = 0; step < 3; ++step) {
        by_file.step();
        by_code.step();
    }
    EXPECT_EQ(by_file.time(), by_code.time());
    for (const std::string& column : by_code.particles().column_names()) {
        const auto a = by_file.particles()[column], b = by_code.particles()[column];
        EXPECT_TRUE(std::ranges::equal(a, b)) << column;
    }
}

TEST(SceneFile, names_the_file_the_place_the_key_and_what_is_allowed) {
    expect_names(error_with("cohesion: 10e3", "cohesio: 1"),
                 {"a.yaml", "materials / soil", "'cohesio'", "possible", "cohesion"});
    expect_names(error_with("cohesion: 10e3", "cohesion: -1"), {"'cohesion'", "at least 0", "Pa"});
    expect_names(error_with("cohesion: 10e3", "cohesion: much"), {"'cohesion'", "finite number"});
    expect_names(error_with("cohesion: 10e3\n", "\n"), {"'cohesion'", "missing"});
    expect_names(error_with("model: drucker_prager", "model: clay"),
                 {"'clay'", "possible", "elastic", "drucker_prager"});
    expect_names(error_with("  walls:", "  wals:"), {"'wals'", "possible lists", "walls"});
    expect_names(error_with("dimension: 2", "dimension: 4"), {"'dimension'", "whole number"});
    expect_names(error_with("shape: polygon", "shape: star"),
                 {"bodies / ground / shapes / outline", "'shape'", "half_space"});
    // Told before the keys that only another shape knows.
    expect_names(error_with("shape: polygon", "shape: cylinder\n          lower: [0, 0]"),
                 {"'shape'", "box, polygon, ball"});
    expect_names(error_with("shape: polygon", "operation: add"), {"'shape'", "missing", "ball"});
    expect_names(error_with("bottom: fixed", "bottom: frictional"), {"'bottom_friction'"});
    expect_names(error_with("    gravity:", "    levity:"), {"'levity'", "possible", "gravity"});
    expect_names(error_with("[0, -9.81]", "[0, 1, 2]"), {"effects / gravity", "list of 2"});
    expect_names(error_with("material: soil", "material: mud"), {"'mud'", "possible: soil"});
    expect_names(error_with("cells: [116, 38]", "cells: [1.5, 38]"), {"'cells'", "whole"});
    expect_names(error_with("cells: [116, 38]", "cells: [116, 38"), {"not understood"});
}

TEST(SceneFile, takes_motions_of_walls_and_effects_of_a_kind) {
    std::string text = text_of(slope_path);
    const auto put = [&](const std::string& before, const std::string& lines) {
        text.insert(text.find(before), lines);
    };
    put("  materials:",
        "    bottom_motion:\n      direction: [1, 0]\n      times: [0, 2]\n"
        "      speeds: [0, 0.5]\n"
        "  planes:\n    lid:\n      point: [0, 30]\n      normal: [0, -1]\n"
        "      kind: fixed\n      motion:\n        direction: [1, 0]\n"
        "        speeds: [-1]\n");
    put("    gravity:",
        "    pull:\n      kind: traction\n      side: right\n      traction: [1, 2]\n");
    const Scene scene = parse_scene(text, SceneFormat::yaml, "a.yaml").scene;
    EXPECT_EQ(scene.walls.bottom.motion.speeds, (std::vector<double>{0, 0.5}));
    EXPECT_EQ(scene.walls.bottom.motion.direction, (Vector{1, 0, 0}));
    EXPECT_EQ(scene.planes.front().wall.motion.times, (std::vector<double>{0}));
    EXPECT_EQ(scene.effects.front().name, "pull");
    EXPECT_EQ(scene.effects.front().kind, "traction");
}

TEST(SceneFile, names_what_is_wrong_with_a_motion_or_a_kind) {
    const auto with_motion = [](const std::string& keys) {
        return error_with("bottom: fixed\n", "bottom: fixed\n    bottom_motion:\n" + keys);
    };
    expect_names(with_motion("      speeds: [1]\n"),
                 {"walls / bottom_motion", "'direction'", "missing"});
    expect_names(with_motion("      direction: [1, 0]\n"), {"'speeds'", "missing"});
    expect_names(with_motion("      direction: [0, 1]\n      speeds: [1]\n"),
                 {"the wall 'bottom' must move along itself"});
    expect_names(
        error_with("bottom: fixed\n", "bottom: fixed\n    front_motion:\n      speeds: [1]\n"),
        {"walls", "'front_motion'", "possible", "bottom_motion"});
    expect_names(error_with("    gravity:", "    weight:\n      kind: levity"),
                 {"'levity'", "possible", "gravity"});
    expect_names(error_with("    gravity:", "    weight:"), {"'weight'", "'kind'"});
}

/// The slope's file with a plane named face.
std::string error_of_plane(const std::string& keys) {
    return error_with("  materials:",
                      "  planes:\n    face:\n      point: [0, 0]\n" + keys + "  materials:");
}

TEST(SceneFile, names_what_is_wrong_with_a_plane) {
    expect_names(error_of_plane("      kind: fixed\n"), {"planes / face", "'normal'", "missing"});
    expect_names(error_of_plane("      normal: [0, 0]\n"), {"plane 'face'", "not zero"});
    expect_names(error_of_plane("      normal: [0, 1]\n      kind: open\n"),
                 {"planes / face", "'kind'", "roller, fixed, frictional"});
    expect_names(error_of_plane("      normal: [0, 1]\n      kind: frictional\n"),
                 {"planes / face", "'friction'", "must be there for a frictional plane"});
    EXPECT_EQ(error_of_plane("      normal: [0, 1]\n      kind: frictional\n      friction: 1\n"),
              "");
}

/// The slope's file with the ground in motion.
SceneFile moving_slope(const std::string& expressions) {
    std::string text = text_of(slope_path);
    const std::string key = "      material: soil\n";
    text.replace(text.find(key), key.size(),
                 key + "      velocity:\n        constant: [3, 0]\n        expressions: " +
                     expressions + "\n");
    return parse_scene(text, SceneFormat::yaml, "a.yaml");
}

std::string error_of_expressions(const std::string& expressions) {
    try {
        const SceneFile file = moving_slope(expressions);
        Simulation simulation(file.scene, MPI_COMM_WORLD);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(SceneFile, takes_expressions_for_a_velocity) {
    const Scene scene =
        moving_slope(R"yaml(["x > 1 ? 2 * x ^ 2 : y", "0.1 * sin(pi * x / 50)"])yaml").scene;
    const VelocityField& velocity = scene.bodies.front().velocity;
    EXPECT_EQ(velocity({4, 7, 0}), (Vector{3 + 32, 0.1 * std::sin(std::numbers::pi * 4 / 50), 0}));
    EXPECT_EQ(velocity({0.5, 7, 0})[0], 3 + 7);
    EXPECT_EQ(moving_slope("[2, 1.5]").scene.bodies.front().velocity({}), (Vector{5, 1.5, 0}));
    EXPECT_DOUBLE_EQ(parse_expression("sqrt(x*x + y*y + z*z) - _e^1 + exp(1)", 3)({2, 3, 6}), 7);
}

TEST(SceneFile, tells_where_an_expression_is_wrong) {
    expect_names(error_of_expressions(R"yaml(["0.1 * sin(q * x)", "0"])yaml"),
                 {"a.yaml", "bodies / ground / velocity", "'expressions'", "\"0.1 * sin(q * x)\"",
                  "position 11", "\"q\"", "possible", "x, y, pi"});
    expect_names(error_of_expressions(R"yaml(["z", "0"])yaml"), {"position 1", "\"z\""});
    expect_names(error_of_expressions(R"yaml(["0", "2 * (x"])yaml"), {"\"2 * (x\"", "position 7"});
    expect_names(error_of_expressions(R"yaml(["x = 3", "0"])yaml"), {"position 3", "== compares"});
    expect_names(error_of_expressions(R"yaml(["x, y", "0"])yaml"),
                 {"position 2", "more than one number"});
    expect_names(error_of_expressions(R"yaml(["", "0"])yaml"), {"position 1", "possible"});
    expect_names(error_of_expressions(R"yaml(["x"])yaml"), {"'expressions'", "list of 2"});
    expect_names(error_of_expressions("1"), {"'expressions'", "list of 2"});
}

// The first points are on the first rank only; all ranks tell of one.
TEST(SceneFile, names_the_point_where_a_velocity_is_none) {
    expect_names(error_of_expressions(R"yaml(["0", "sqrt(x - 0.2)"])yaml"),
                 {"bodies / ground", "x = 0.0948276", "must be finite"});
}

TEST(SceneFile, of_the_bar_starts_as_the_bar_of_the_tests) {
    const Scene scene = read_scene(RRCB_SCENES "/axial_bar.yaml", MPI_COMM_WORLD).scene;
    const VelocityField form = velocity_field(
        {.sine_amplitude = {0.1, 0}, .sine_wave_number = {std::numbers::pi / 50, 0}});
    for (double x = 0; x < 25; x += 0.25)
        EXPECT_NEAR(scene.bodies.front().velocity({x, 0.5})[0], form({x, 0.5})[0], 1e-16);
}

TEST(SceneFile, that_is_not_there_is_told_on_every_rank) {
    EXPECT_THROW(read_scene("nowhere.yaml", MPI_COMM_WORLD), std::invalid_argument);
}

const std::string xml = R"xml(<ParameterList name="scene">
  <Parameter name="dimension" type="int" value="3"/>
  <Parameter name="end_time" type="double" value="1"/>
  <ParameterList name="domain">
    <Parameter name="lower" type="Array(double)" value="{0,0,0}"/>
    <Parameter name="cells" type="Array(int)" value="{4,4,4}"/>
    <Parameter name="cell_size" type="double" value="0.5"/>
  </ParameterList>
  <ParameterList name="materials"><ParameterList name="rubber">
    <Parameter name="model" type="string" value="elastic"/>
    <Parameter name="density" type="double" value="1000"/>
    <Parameter name="youngs_modulus" type="double" value="1e6"/>
    <Parameter name="poissons_ratio" type="double" value="0.3"/>
  </ParameterList></ParameterList>
  <ParameterList name="bodies"><ParameterList name="block">
    <Parameter name="material" type="string" value="rubber"/>
    <ParameterList name="shapes">
      <ParameterList name="all">
        <Parameter name="shape" type="string" value="box"/>
        <Parameter name="lower" type="Array(double)" value="{0,0,0}"/>
        <Parameter name="upper" type="Array(double)" value="{1,1,1}"/>
      </ParameterList>
      <ParameterList name="corner">
        <Parameter name="shape" type="string" value="ball"/>
        <Parameter name="operation" type="string" value="subtract"/>
        <Parameter name="centre" type="Array(double)" value="{0,0,0}"/>
        <Parameter name="radius" type="double" value="0.3"/>
      </ParameterList>
    </ParameterList>
  </ParameterList></ParameterList>
</ParameterList>)xml";

// A block of 4 x 4 x 4 points at 1/8, 3/8, ...: the ball of 0.3 holds the one at 0.2165 from the
// corner; the next are at 0.4146.
TEST(SceneFile, may_be_xml_and_takes_shapes_away) {
    const SceneFile file = parse_scene(xml, SceneFormat::xml, "block.xml");
    EXPECT_EQ(file.scene.name, "block");
    EXPECT_EQ(extent_of(file.scene).num_points, 63);
}

TEST(SceneFile, is_the_same_in_xml_and_yaml) {
    const SceneFile yaml = read_scene(RRCB_SCENES "/piston.yaml", MPI_COMM_WORLD);
    const SceneFile xml_file = read_scene(RRCB_SCENES "/piston.xml", MPI_COMM_WORLD);
    EXPECT_EQ(yaml.output.every_time, xml_file.output.every_time);
    EXPECT_EQ(yaml.scene.end_time, xml_file.scene.end_time);
    EXPECT_EQ(yaml.scene.probes.back().position, xml_file.scene.probes.back().position);
    Simulation a(yaml.scene, MPI_COMM_WORLD), b(xml_file.scene, MPI_COMM_WORLD);
    for (int step = 0; step < 30; ++step) {
        a.step();
        b.step();
    }
    for (const std::string& column : a.particles().column_names())
        EXPECT_TRUE(std::ranges::equal(a.particles()[column], b.particles()[column])) << column;
}

TEST(SceneFile, can_be_given_other_cells) {
    Scene scene = parse_scene(xml, SceneFormat::xml, "block.xml").scene;
    resize_cells(scene, 0.25);
    EXPECT_EQ(scene.grid.num_cells, (std::array<int, 3>{8, 8, 8}));
    resize_cells(scene, 0.3);
    EXPECT_EQ(scene.grid.num_cells, (std::array<int, 3>{7, 7, 7}));
}

TEST(Region, polygon_holds_its_rim) {
    const Region l = polygon_region({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
    EXPECT_TRUE(l({0.5, 1.5}));
    EXPECT_TRUE(l({1, 1.5}));
    EXPECT_TRUE(l({2, 1}));
    EXPECT_FALSE(l({1.5, 1.5}));
    EXPECT_FALSE(l({-0.1, 0.5}));
    EXPECT_FALSE(l({1.5, 1.0001}));
}

TEST(VelocityField, is_a_sum_of_forms) {
    const VelocityField field = velocity_field({.constant = {1, 2, 3},
                                                .rotation_rate = 2,
                                                .rotation_centre = {1, 0, 0},
                                                .sine_amplitude = {0, 0, 1},
                                                .sine_wave_number = {0, 0, 1},
                                                .sine_phase = 0});
    const Vector velocity = field({3, 1, 0.5});
    EXPECT_DOUBLE_EQ(velocity[0], 1 - 2 * 1);
    EXPECT_DOUBLE_EQ(velocity[1], 2 + 2 * 2);
    EXPECT_DOUBLE_EQ(velocity[2], 3 + std::sin(0.5));
}

}  // namespace
}  // namespace mpm::test
