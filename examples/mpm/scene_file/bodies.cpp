#include "scene_file/bodies.hpp"

#include "scene_file/expression.hpp"

#include <mpm/region.hpp>

#include <cmath>

namespace mpm {

namespace {

/// Rules of a shape, `shape` and `operation` among them.
std::vector<Rule> shape_rules(const std::string& shape) {
    std::vector<Rule> rules{{.name = "shape",
                             .kind = Rule::Kind::word,
                             .choices = {"box", "polygon", "ball", "half_space"}},
                            choice("operation", {"add", "subtract", "intersect"})};
    const auto add = [&](std::vector<Rule> more) {
        rules.insert(rules.end(), more.begin(), more.end());
    };
    if (shape == "box") add({vector("lower", "m"), vector("upper", "m")});
    if (shape == "ball") add({vector("centre", "m"), positive("radius", "m")});
    if (shape == "half_space") add({vector("point", "m"), vector("normal", "")});
    return rules;
}

std::string word_of(const List& list, const std::string& name) {
    const Parameters parameters = list.parameters();
    const auto found = parameters.find(name);
    if (found == parameters.end() || !std::holds_alternative<std::string>(found->second)) return "";
    return std::get<std::string>(found->second);
}

Region make_region(const Values& values, const std::vector<Vector>& corners, int dimension) {
    const std::string& shape = values.word("shape");
    if (shape == "polygon") return polygon_region(corners);
    if (shape == "ball")
        return ball_region(vector_of(values.list("centre")), values.number("radius"));
    if (shape == "half_space")
        return half_space_region(vector_of(values.list("point")), vector_of(values.list("normal")));
    Box box{vector_of(values.list("lower")), vector_of(values.list("upper"))};
    for (auto a = static_cast<std::size_t>(dimension); a < 3; ++a) box.upper[a] = box.lower[a];
    return box_region(box);
}

Region combined(Region whole, const std::string& operation, Region part) {
    if (operation == "subtract") return without(std::move(whole), std::move(part));
    if (operation == "intersect") return common_to(std::move(whole), std::move(part));
    return both_of(std::move(whole), std::move(part));
}

/// The shapes of a body, combined in their order.
Region read_region(List shapes, int dimension) {
    Region whole = [](const Vector&) { return false; };
    const std::vector<std::string> names = shapes.sublist_names();
    if (names.empty())
        throw std::invalid_argument(shapes.place() + " is missing; it must be named shapes");
    for (const std::string& name : names) {
        List list = shapes.take_list(name);
        std::vector<Vector> corners;
        // Corners are rows of x and y, in three dimensions too. All else is plain parameters.
        if (list.has("corners")) corners = list.take_rows("corners", 2);
        const std::string shape = word_of(list, "shape");
        const Values values = list.values(shape_rules(shape), dimension);
        if (shape == "polygon" ? corners.size() < 3 : !corners.empty())
            list.refuse("corners",
                        "must be the 3 or more rows (x, y) of a polygon, and of nothing "
                        "else");
        whole = combined(std::move(whole), values.word("operation"),
                         make_region(values, corners, dimension));
    }
    return whole;
}

/// The velocity that expressions give along each axis.
VelocityField read_expressions(List& list, int dimension) {
    std::vector<Expression> components;
    for (const std::string& text : list.take_texts("expressions", dimension)) try {
            components.push_back(parse_expression(text, dimension));
        } catch (const std::invalid_argument& error) {
            list.refuse("expressions", std::string("has ") + error.what());
        }
    return [components](const Vector& at) {
        Vector velocity{};
        for (std::size_t a = 0; a < components.size(); ++a) velocity[a] = components[a](at);
        return velocity;
    };
}

VelocityField sum_of(VelocityField one, VelocityField other) {
    return [one = std::move(one), other = std::move(other)](const Vector& at) {
        Vector velocity = one(at);
        const Vector more = other(at);
        for (std::size_t a = 0; a < velocity.size(); ++a) velocity[a] += more[a];
        return velocity;
    };
}

VelocityField read_velocity(List list, int dimension) {
    VelocityField expressions;
    if (list.has("expressions")) expressions = read_expressions(list, dimension);
    const std::vector<double> zero(static_cast<std::size_t>(dimension), 0.0);
    const Values values =
        list.values({vector("constant", "m/s", zero), number("rotation_rate", "rad/s", 0.0),
                     vector("rotation_centre", "m", zero), vector("sine_amplitude", "m/s", zero),
                     vector("sine_wave_number", "rad/m", zero), number("sine_phase", "rad", 0.0)},
                    dimension);
    VelocityField forms =
        velocity_field({.constant = vector_of(values.list("constant")),
                        .rotation_rate = values.number("rotation_rate"),
                        .rotation_centre = vector_of(values.list("rotation_centre")),
                        .sine_amplitude = vector_of(values.list("sine_amplitude")),
                        .sine_wave_number = vector_of(values.list("sine_wave_number")),
                        .sine_phase = values.number("sine_phase")});
    return expressions ? sum_of(std::move(forms), std::move(expressions)) : forms;
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
    const Region region = read_region(list.take_list("shapes"), dimension);
    const VelocityField velocity = read_velocity(list.take_list("velocity"), dimension);
    const std::vector<double> two(static_cast<std::size_t>(dimension), 2.0);
    const Values values = list.values(
        {vector("points_per_cell", "", two), {.name = "material", .kind = Rule::Kind::word}},
        dimension);
    return {
        .contains = region,
        .points_per_cell = whole_numbers(list, "points_per_cell", values.list("points_per_cell")),
        .material = values.word("material"),
        .velocity = velocity,
        .name = name};
}

}  // namespace mpm
