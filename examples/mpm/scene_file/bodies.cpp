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
    return rules;
}

/// The word that tells the shape. It is checked first: the other keys depend on it.
std::string read_kind(const List& list, int dimension) {
    const Parameters parameters = list.parameters();
    Parameters given;
    if (const auto found = parameters.find(shape_rule.name); found != parameters.end())
        given.insert(*found);
    return Values(given, {&shape_rule, 1}, list.place(), dimension).word(shape_rule.name);
}

/// Refuses a box that would hold nothing.
void check_corners(const List& list, const Values& values) {
    const std::vector<double>&lower = values.list("lower"), &upper = values.list("upper");
    for (std::size_t a = 0; a < lower.size(); ++a)
        if (!(lower[a] < upper[a]))
            list.refuse("upper", std::string("must lie above 'lower' along ") + "xyz"[a]);
}

/// A shape and a box around it.
struct Shape {
    Region region;
    Box bounds = everywhere;
};

Shape box_shape(const Values& values, int dimension) {
    Box box{vector_of(values.list("lower")), vector_of(values.list("upper"))};
    for (auto a = static_cast<std::size_t>(dimension); a < 3; ++a) box.upper[a] = box.lower[a];
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

Shape polygon_shape(const std::vector<Vector>& corners) {
    Shape polygon{polygon_region(corners)};
    for (std::size_t a = 0; a < 2; ++a) {
        const auto along = [a](const Vector& corner) { return corner[a]; };
        polygon.bounds.lower[a] = std::ranges::min(corners, {}, along)[a];
        polygon.bounds.upper[a] = std::ranges::max(corners, {}, along)[a];
    }
    return polygon;
}

Shape make_shape(const Values& values, const std::vector<Vector>& corners, int dimension) {
    const std::string& shape = values.word(shape_rule.name);
    if (shape == "polygon") return polygon_shape(corners);
    if (shape == "ball") return ball_shape(values);
    if (shape == "box") return box_shape(values, dimension);
    return {half_space_region(vector_of(values.list("point")), vector_of(values.list("normal")))};
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

/// One shape of a list, and the operation that it is combined by.
std::pair<Shape, std::string> read_shape(List list, int dimension) {
    std::vector<Vector> corners;
    // Corners are rows of x and y, in three dimensions too. All else is plain parameters.
    if (list.has("corners")) corners = list.take_rows("corners", 2);
    const std::string shape = read_kind(list, dimension);
    const Values values = list.values(shape_rules(shape), dimension);
    if (shape == "polygon" ? corners.size() < 3 : !corners.empty())
        list.refuse("corners",
                    "must be the 3 or more rows (x, y) of a polygon, and of nothing else");
    if (shape == "box") check_corners(list, values);
    return {make_shape(values, corners, dimension), values.word("operation")};
}

/// The shapes of a body, combined in their order.
Shape read_shapes(List shapes, int dimension) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Shape whole{[](const Vector&) { return false; },
                {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}}};
    const std::vector<std::string> names = shapes.sublist_names();
    if (names.empty())
        throw std::invalid_argument(shapes.place() + " is missing; it must be named shapes");
    for (const std::string& name : names) {
        auto [part, operation] = read_shape(shapes.take_list(name), dimension);
        whole = combined(std::move(whole), operation, std::move(part));
    }
    return whole;
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

Body read_body(List list, const std::string& name, int dimension) {
    const Shape shape = read_shapes(list.take_list("shapes"), dimension);
    const VelocityField velocity = read_velocity(list.take_list("velocity"), dimension);
    const std::vector<double> two(static_cast<std::size_t>(dimension), 2.0);
    const Values values = list.values(
        {vector("points_per_cell", "", two), {.name = "material", .kind = Rule::Kind::word}},
        dimension);
    return {
        .contains = shape.region,
        .points_per_cell = whole_numbers(list, "points_per_cell", values.list("points_per_cell")),
        .material = values.word("material"),
        .velocity = velocity,
        .name = name,
        .bounds = shape.bounds};
}

}  // namespace mpm
