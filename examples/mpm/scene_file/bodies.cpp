#include "scene_file/bodies.hpp"

#include <mpm/region.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mpm {

namespace {

const Rule shape_rule{
    .name = "shape", .kind = Rule::Kind::word, .choices = {"box", "polygon", "ball", "half_space"}};

/// Rules of a shape, `shape` and `operation` among them.
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

/// Corners are rows of x and y, in three dimensions too.
Shape polygon_shape(const List& list, const std::vector<double>& rows) {
    if (rows.size() < 6 || rows.size() % 2 != 0)
        list.refuse("corners", "must be 3 or more rows (x, y)");
    std::vector<Vector> corners;
    for (std::size_t k = 0; k < rows.size(); k += 2) corners.push_back({rows[k], rows[k + 1]});
    Shape polygon{polygon_region(corners)};
    for (std::size_t a = 0; a < 2; ++a) {
        const auto along = [a](const Vector& corner) { return corner[a]; };
        polygon.bounds.lower[a] = std::ranges::min(corners, {}, along)[a];
        polygon.bounds.upper[a] = std::ranges::max(corners, {}, along)[a];
    }
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

/// Combines a shape of a list with those before it.
Shape with_shape(Shape whole, const List& list, int dimension) {
    // The word for the shape is checked first: the other keys depend on it.
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
    return velocity_field({.constant = vector_of(values.list("constant")),
                           .rotation_rate = values.number("rotation_rate"),
                           .rotation_centre = vector_of(values.list("rotation_centre")),
                           .sine_amplitude = vector_of(values.list("sine_amplitude")),
                           .sine_wave_number = vector_of(values.list("sine_wave_number")),
                           .sine_phase = values.number("sine_phase")});
}

}  // namespace

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

}  // namespace mpm
