#include "scene/lattice.hpp"
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
        parse_scene(text, "a.yaml");
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
    expect_names(error_with("cells: [116, 38]", "cells: [116, 38"),
                 {"not understood", "near 'cell_size: 0.948"});
    expect_names(error_with("\nscene:", "\nscenery:"), {"named scene, not 'scenery'"});
    expect_names(error_with("dimension: 2", "dimension: 2\n  dimension: 2"),
                 {"\"dimension\" already exists"});
    const std::string cyrillic =
        error_with("cohesion: 10e3", "\u0441\u0432\u044f\u0437\u044c: 10e3");
    expect_names(cyrillic, {"'\u0441\u0432\u044f\u0437\u044c: 10e3'", "not ASCII"});
    EXPECT_EQ(cyrillic.find('\n'), std::string::npos);
}

TEST(SceneFile, names_what_cannot_be_meant) {
    expect_names(error_with("material: soil",
                            "material: soil\n      velocity:\n        constant: [1e200, 0]"),
                 {"bodies / ground / velocity", "'constant'", "light"});
    Scene scene = slope_scene(22);
    scene.materials.front() = clay_material(70e6, 1e4);
    scene.bodies.front().material = "clay";
    validate(scene);
    scene.materials.front().parameters["softening_strain"] = 2.0;
    try {
        validate(scene);
        FAIL() << "it is accepted";
    } catch (const std::invalid_argument& error) {
        expect_names(error.what(), {"materials / clay", "'softening_strain'", "'residual_ratio'"});
    }
    expect_names(error_with("corners: [[0, -15], [110, -15], [110, 0], [50, 0], [30, 20], [0, 20]]",
                            "corners: [[0, 0], [1, 1], [2, 2]]"),
                 {"shapes / outline", "'corners'", "on one line"});
}

/// The slope's file with a plane named face.
std::string error_of_plane(const std::string& keys) {
    return error_with("  materials:",
                      "  planes:\n    face:\n      point: [0, 0]\n" + keys + "  materials:");
}

TEST(SceneFile, names_what_is_wrong_with_a_plane) {
    expect_names(error_of_plane("      friction: 1\n"), {"planes / face", "'normal'", "missing"});
    expect_names(error_of_plane("      normal: [0, 0]\n      friction: 1\n"),
                 {"plane 'face'", "not zero"});
    expect_names(error_of_plane("      normal: [0, 1]\n      kind: open\n"),
                 {"planes / face", "'kind'", "frictional"});
    expect_names(error_of_plane("      normal: [0, 1]\n      kind: frictional\n"),
                 {"planes / face", "'friction'", "missing"});
    EXPECT_EQ(error_of_plane("      normal: [0, 1]\n      kind: frictional\n      friction: 1\n"),
              "");
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

TEST(SceneFile, can_be_given_other_cells) {
    Scene scene = read_scene(RRCB_SCENES "/axial_bar.yaml", MPI_COMM_WORLD).scene;
    resize_cells(scene, 0.5);
    EXPECT_EQ(scene.grid.num_cells, (std::array<int, 3>{56, 2, 0}));
    resize_cells(scene, 0.3);
    EXPECT_EQ(scene.grid.num_cells, (std::array<int, 3>{94, 4, 0}));
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
