#include "scene_file/scene_file_mpi.hpp"

#include "parallel/communicator_mpi.hpp"
#include "scene_file/list.hpp"

#include <mpm/region.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace mpm {

namespace {

constexpr double most_steps = 1e9;

/// Returns the whole numbers of a list along the axes, each at least 1, and 1 for missing axes.
std::array<int, 3> whole_numbers(const List& list, const std::string& name,
                                 const std::vector<double>& numbers) {
    constexpr double most = 1e6;
    std::array<int, 3> whole{1, 1, 1};
    for (std::size_t a = 0; a < numbers.size(); ++a) {
        if (!(numbers[a] >= 1 && numbers[a] <= most && numbers[a] == std::floor(numbers[a])))
            list.refuse(name, "must be whole numbers from 1 to 1000000");
        whole[a] = static_cast<int>(numbers[a]);
    }
    return whole;
}

const Rule shape_rule{
    .name = "shape", .kind = Rule::Kind::word, .choices = {"box", "polygon", "ball", "half_space"}};

/// Returns the rules of a shape's parameters, including `shape` and `operation`.
std::vector<Rule> shape_rules(const std::string& shape) {
    std::vector<Rule> rules{shape_rule, choice("operation", {"add", "subtract", "intersect"})};
    const auto add = [&](std::vector<Rule> more) {
        rules.insert(rules.end(), more.begin(), more.end());
    };
    if (shape == "box") add({vector("lower", "m"), vector("upper", "m")});
    if (shape == "ball") add({vector("centre", "m"), positive("radius", "m")});
    if (shape == "half_space") add({vector("point", "m"), vector("normal", "")});
    if (shape == "polygon") add({rows("corners", "m")});
    return rules;
}

/// A shape and a box around it.
struct Shape {
    Region region;
    Box bounds = everywhere;
};

Shape box_shape(const List& list, const Values& values) {
    const std::vector<double>&lower = values.list("lower"), &upper = values.list("upper");
    for (std::size_t a = 0; a < lower.size(); ++a)
        if (!(lower[a] < upper[a]))
            list.refuse("upper", std::string("must lie above 'lower' along ") + "xyz"[a]);
    const Box box{vector_of(lower), vector_of(upper)};
    return {box_region(box), box};
}

Shape ball_shape(const Values& values) {
    const Vector centre = vector_of(values.list("centre"));
    const double radius = values.number("radius");
    Shape ball{ball_region(centre, radius), {centre, centre}};
    for (std::size_t a = 0; a < 3; ++a) {
        ball.bounds.lower[a] -= radius;
        ball.bounds.upper[a] += radius;
    }
    return ball;
}

/// Returns twice the area of a polygon, by the shoelace formula.
double twice_area(const std::vector<Vector>& corners) {
    double sum = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vector &a = corners[k], &b = corners[(k + 1) % corners.size()];
        sum += (a[0] - corners[0][0]) * (b[1] - corners[0][1]) -
               (b[0] - corners[0][0]) * (a[1] - corners[0][1]);
    }
    return std::abs(sum);
}

/// Returns a polygon. Its corners are rows of x and y, in three dimensions too.
Shape polygon_shape(const List& list, const std::vector<double>& rows) {
    if (rows.size() < 6 || rows.size() % 2 != 0)
        list.refuse("corners", "must be 3 or more rows (x, y)");
    std::vector<Vector> corners;
    for (std::size_t k = 0; k < rows.size(); k += 2) corners.push_back({rows[k], rows[k + 1]});
    if (crosses_itself(corners)) list.refuse("corners", "must be in order: two edges cross");
    Shape polygon{polygon_region(corners)};
    for (std::size_t a = 0; a < 2; ++a) {
        const auto along = [a](const Vector& corner) { return corner[a]; };
        polygon.bounds.lower[a] = std::ranges::min(corners, {}, along)[a];
        polygon.bounds.upper[a] = std::ranges::max(corners, {}, along)[a];
    }
    const double width = polygon.bounds.upper[0] - polygon.bounds.lower[0];
    const double height = polygon.bounds.upper[1] - polygon.bounds.lower[1];
    if (!(twice_area(corners) > 1e-9 * std::pow(std::max(width, height), 2)))
        list.refuse("corners", "must enclose an area: they are on one line");
    return polygon;
}

Shape combined(Shape whole, const std::string& operation, Shape part) {
    if (operation == "subtract")
        return {without(std::move(whole.region), std::move(part.region)), whole.bounds};
    const bool is_common = operation == "intersect";
    Box& box = whole.bounds;
    for (std::size_t a = 0; a < 3; ++a) {
        const double lower = part.bounds.lower[a], upper = part.bounds.upper[a];
        box.lower[a] = is_common ? std::max(box.lower[a], lower) : std::min(box.lower[a], lower);
        box.upper[a] = is_common ? std::min(box.upper[a], upper) : std::max(box.upper[a], upper);
    }
    const auto combine = is_common ? common_to : both_of;
    whole.region = combine(std::move(whole.region), std::move(part.region));
    return whole;
}

/// Combines a shape of a list with the previous shapes.
Shape with_shape(Shape whole, const List& list, int dimension) {
    // Checks the name of the shape first, because the allowed parameters depend on it.
    List kind = list;
    std::erase_if(kind.parameters, [](const auto& entry) { return entry.first != "shape"; });
    const std::string shape = kind.values({shape_rule}, dimension).word("shape");
    const Values values = list.values(shape_rules(shape), dimension);
    Shape part;
    if (shape == "polygon") part = polygon_shape(list, values.list("corners"));
    if (shape == "ball") part = ball_shape(values);
    if (shape == "box") part = box_shape(list, values);
    if (shape == "half_space")
        part.region =
            half_space_region(vector_of(values.list("point")), vector_of(values.list("normal")));
    return combined(std::move(whole), values.word("operation"), std::move(part));
}

VelocityField read_velocity(const List& list, int dimension) {
    const std::vector<double> zero(static_cast<std::size_t>(dimension), 0.0);
    const Values values =
        list.values({vector("constant", "m/s", zero), number("rotation_rate", "rad/s", 0.0),
                     vector("rotation_centre", "m", zero), vector("sine_amplitude", "m/s", zero),
                     vector("sine_wave_number", "rad/m", zero), number("sine_phase", "rad", 0.0)},
                    dimension);
    constexpr double light = 3e8;
    for (const char* key : {"constant", "sine_amplitude"})
        for (const double component : values.list(key))
            if (!(std::abs(component) < light))
                list.refuse(key, "must be slower than light, 3e8 m/s");
    return velocity_field({.constant = vector_of(values.list("constant")),
                           .rotation_rate = values.number("rotation_rate"),
                           .rotation_centre = vector_of(values.list("rotation_centre")),
                           .sine_amplitude = vector_of(values.list("sine_amplitude")),
                           .sine_wave_number = vector_of(values.list("sine_wave_number")),
                           .sine_phase = values.number("sine_phase")});
}

/// Returns the body that a list describes.
Body read_body(const List& list, int dimension) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Shape shape{[](const Vector&) { return false; },
                {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}};
    const std::vector<List> shapes = list.lists_in("shapes");
    if (shapes.empty()) list.refuse("shapes", "is missing; it must be a list of shapes");
    for (const List& one : shapes) shape = with_shape(std::move(shape), one, dimension);
    const std::vector<double> two(static_cast<std::size_t>(dimension), 2.0);
    const Values values = list.values(
        {vector("points_per_cell", "", two), {.name = "material", .kind = Rule::Kind::word}},
        dimension, {"shapes", "velocity"});
    return {
        .contains = shape.region,
        .points_per_cell = whole_numbers(list, "points_per_cell", values.list("points_per_cell")),
        .material = values.word("material"),
        .velocity = read_velocity(list.list("velocity"), dimension),
        .name = list.name,
        .bounds = shape.bounds};
}

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
                                       within("courant_number", "", 1e-6, 1, scene.courant_number)},
                                      dimension);
    if (values.word("shape_function") == "quadratic")
        scene.shape_function = ShapeFunction::quadratic;
    scene.courant_number = values.number("courant_number");
}

OutputPlan read_output(const List& list, int dimension) {
    const Values values = list.values(
        {whole("history_every", "steps", 0, most_steps, 10.0),
         whole("vtk_every", "steps", 0, most_steps, 0.0), not_negative("every_time", "s", 0.0)},
        dimension);
    return {static_cast<int>(values.number("history_every")),
            static_cast<int>(values.number("vtk_every")), values.number("every_time")};
}

/// Removes a word from the parameters of a list and returns it; empty if there is none.
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
    for (const List& one : list.lists_in("effects")) {
        one.check_lists({});
        scene.effects.push_back({one.name, one.parameters});
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

/// Returns the text of a file, or an empty text if it cannot be read.
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
