#include "scene_file/scene_file_mpi.hpp"

#include "parallel/communicator_mpi.hpp"
#include "scene_file/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace mpm {

namespace {

constexpr double most_steps = 1e9;

GridShape read_domain(const List& list, int dimension) {
    const Values values = list.values(
        {vector("lower", "m"), vector("cells", ""), positive("cell_size", "m")}, dimension);
    GridShape grid{.lower = vector_of(values.list("lower")),
                   .spacing = values.number("cell_size"),
                   .num_cells = whole_numbers(list, "cells", values.list("cells"))};
    for (auto a = static_cast<std::size_t>(dimension); a < 3; ++a) grid.num_cells[a] = 0;
    return grid;
}

Walls read_walls(const List& list, int dimension) {
    Walls walls;
    const std::vector<std::pair<std::string, Wall*>> sides{
        {"left", &walls.left}, {"right", &walls.right}, {"bottom", &walls.bottom},
        {"top", &walls.top},   {"back", &walls.back},   {"front", &walls.front}};
    const auto num_sides = static_cast<std::size_t>(2 * dimension);
    std::vector<Rule> rules;
    for (std::size_t side = 0; side < num_sides; ++side) {
        rules.push_back(choice(sides[side].first, {"open", "roller", "fixed", "frictional"}));
        rules.push_back(optional(not_negative(sides[side].first + "_friction", "")));
    }
    const Values values = list.values(rules, dimension);
    for (std::size_t side = 0; side < num_sides; ++side) {
        const auto& [name, wall] = sides[side];
        const auto& kinds = rules[2 * side].choices;
        wall->kind =
            static_cast<Wall::Kind>(std::ranges::find(kinds, values.word(name)) - kinds.begin());
        if ((wall->kind == Wall::frictional) != values.has(name + "_friction"))
            list.refuse(name + "_friction", "must be there for a frictional wall, and only there");
        if (wall->kind == Wall::frictional) wall->friction = values.number(name + "_friction");
    }
    return walls;
}

Plane read_plane(const List& list, int dimension) {
    const Values values =
        list.values({vector("point", "m"), vector("normal", ""), choice("kind", {"frictional"}),
                     not_negative("friction", "")},
                    dimension);
    return {list.name, vector_of(values.list("point")), vector_of(values.list("normal")),
            values.number("friction")};
}

void read_method(const List& list, int dimension, Scene& scene) {
    const Values values = list.values({choice("shape_function", {"linear", "quadratic"}),
                                       within("courant_number", "", 1e-6, 1, scene.courant_number),
                                       within("least_node_mass", "", 0, 0.5, 0.0)},
                                      dimension);
    if (values.word("shape_function") == "quadratic")
        scene.shape_function = ShapeFunction::quadratic;
    scene.courant_number = values.number("courant_number");
    scene.least_node_mass = values.number("least_node_mass");
}

OutputPlan read_output(const List& list, int dimension) {
    const Values values = list.values(
        {whole("history_every", "steps", 0, most_steps, 10.0),
         whole("vtk_every", "steps", 0, most_steps, 0.0), not_negative("every_time", "s", 0.0)},
        dimension);
    return {static_cast<int>(values.number("history_every")),
            static_cast<int>(values.number("vtk_every")), values.number("every_time")};
}

/// Takes a word out of the parameters of a list; empty if there is none.
std::string take_word(const std::string& name, List& list) {
    list.check_lists({});
    const auto word = list.parameters.extract(name);
    if (!word || !std::holds_alternative<std::string>(word.mapped())) return "";
    return std::get<std::string>(word.mapped());
}

SceneFile read_list(const List& list, const std::string& name) {
    const Values values = list.values({whole("dimension", "", 2, 3), positive("end_time", "s")}, 2,
                                      {"domain", "walls", "planes", "materials", "bodies",
                                       "effects", "probes", "method", "output"});
    const int dimension = static_cast<int>(values.number("dimension"));
    SceneFile file;
    Scene& scene = file.scene;
    scene.name = name;
    scene.dimension = dimension;
    scene.end_time = values.number("end_time");
    scene.grid = read_domain(list.list("domain"), dimension);
    scene.walls = read_walls(list.list("walls"), dimension);
    for (const List& one : list.lists_in("planes"))
        scene.planes.push_back(read_plane(one, dimension));
    for (List& one : list.lists_in("materials")) {
        const std::string model = take_word("model", one);
        scene.materials.push_back({one.name, model, one.parameters});
    }
    for (const List& one : list.lists_in("bodies"))
        scene.bodies.push_back(read_body(one, dimension));
    for (List& one : list.lists_in("effects")) {
        const std::string kind = take_word("kind", one);
        scene.effects.push_back({one.name, one.parameters, kind});
    }
    for (const List& one : list.lists_in("probes"))
        scene.probes.push_back(
            {one.name,
             vector_of(one.values({vector("position", "m")}, dimension).list("position"))});
    read_method(list.list("method"), dimension, scene);
    file.output = read_output(list.list("output"), dimension);
    validate(scene);
    return file;
}

/// The text of a file, or nothing when it cannot be read.
std::string text_of(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace

SceneFile parse_scene(const std::string& text, const std::string& name) {
    try {
        return read_list(parse_list(text), std::filesystem::path(name).stem());
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(name + ": " + error.what());
    }
}

SceneFile read_scene(const std::string& path, MPI_Comm comm) {
    const std::string text = broadcast(rank_of(comm) == 0 ? text_of(path) : "", comm);
    if (text.empty())
        throw std::invalid_argument(path +
                                    ": cannot be read, or is empty; it must be a scene file");
    return parse_scene(text, path);
}

void resize_cells(Scene& scene, double cell_size) {
    constexpr double tolerance = 1e-9;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
        const double cells = scene.grid.num_cells[a] * (scene.grid.spacing / cell_size);
        scene.grid.num_cells[a] = std::max(1, static_cast<int>(std::ceil(cells - tolerance)));
    }
    scene.grid.spacing = cell_size;
}

}  // namespace mpm
