#include "lists/periodic_images.hpp"

#include "arithmetic/infinity.hpp"
#include "options/rejection.hpp"
#include "options/validation.hpp"

#include <rrcb/detail/mix.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string>

namespace rrcb {

namespace {

std::string text_of(double number) {
    char text[32];
    return {text, std::to_chars(std::begin(text), std::end(text), number).ptr};
}

}  // namespace

double image_of(double x, const Box& box, int axis, std::int32_t shift) {
    return shift == 0 ? x : x + shift * (box.upper[axis] - box.lower[axis]);
}

PeriodicImages::PeriodicImages(const Box& box, int dimension)
    : box_(box), dimension_(std::min(dimension, max_dimension)) {}

bool PeriodicImages::is_periodic(int axis) const {
    return std::isfinite(box_.lower[axis]);
}

void PeriodicImages::check(double radius) const {
    constexpr double most_periods = 100;
    for (int a = 0; a < dimension_; ++a) {
        const double period = box_.upper[a] - box_.lower[a];
        require(period > 0 && std::isfinite(period) == is_periodic(a) &&
                    std::isfinite(box_.upper[a]) == is_periodic(a),
                "each axis of the periodic box must have two finite ends, the lower one first, or "
                "two infinite ones");
        require(radius / most_periods <= period, "a cutoff must be at most 100 periods");
    }
}

void PeriodicImages::check(const Points& points, const Box& all) const {
    bool are_inside = true;
    for (int a = 0; a < dimension_ && points.count > 0; ++a)
        are_inside = are_inside && all.lower[a] >= box_.lower[a] && all.upper[a] <= box_.upper[a];
    if (are_inside) return;
    for (LocalIndex i = 0; i < points.count; ++i)
        for (int a = 0; a < dimension_; ++a) {
            const double x = points.coordinate(i, a);
            if (x >= box_.lower[a] && x <= box_.upper[a]) continue;
            reject("coordinate " + text_of(x) + " of point " + std::to_string(i) + " on axis " +
                   std::to_string(a) + " is outside the periodic box, " + text_of(box_.lower[a]) +
                   " to " + text_of(box_.upper[a]));
        }
}

Vector PeriodicImages::image(const Vector& x, const Shift& shift) const {
    Vector image = x;
    for (int a = 0; a < dimension_; ++a) image[a] = image_of(x[a], box_, a, shift[a]);
    return image;
}

std::uint64_t PeriodicImages::hash() const {
    std::uint64_t hash = 1;
    for (int a = 0; a < dimension_; ++a)
        for (const double end : {box_.lower[a], box_.upper[a]})
            hash = detail::mix(hash ^ std::bit_cast<std::uint64_t>(end + 0.0));
    return hash;
}

namespace {

/// Returns a coordinate moved to that of its image. The image of a coordinate inside the box must
/// not be in [lower, upper), although rounding may bring it there; the image of the upper face is
/// on the lower one. A point that has left the box since the plan was made may enter on the other
/// side.
template <class T>
T image_outside(T x, const Box& box, int axis, std::int32_t shift) {
    const auto image = static_cast<T>(image_of(x, box, axis, shift));
    if (!(x >= box.lower[axis] && x <= box.upper[axis])) return image;
    const auto towards = [](T from, double to) { return std::nextafter(from, static_cast<T>(to)); };
    auto end = static_cast<T>(shift > 0 ? box.upper[axis] : box.lower[axis]);
    if (shift > 0) {
        if (end < box.upper[axis]) end = towards(end, infinity);
        return std::max(image, end);
    }
    if (shift < 0) {
        if (!(end < box.lower[axis])) end = towards(end, -infinity);
        return std::min(image, end);
    }
    return image;
}

template <class T>
void apply_shifts_to(std::span<T> positions, const GhostPlan& plan) {
    if (plan.shifts.empty()) return;
    const std::size_t dimension = positions.size() / plan.shifts.size();
    require(dimension >= 1 && dimension <= max_dimension &&
                positions.size() == dimension * plan.shifts.size(),
            "positions must have an entry for each axis of each ghost");
    const Box box = plan.periodic.value_or(Box());
    for (std::size_t k = 0; k < positions.size(); ++k) {
        const int axis = static_cast<int>(k % dimension);
        positions[k] = image_outside(positions[k], box, axis, plan.shifts[k / dimension][axis]);
    }
}

/// Moves the positions in a view along one axis.
template <class T>
void apply_shifts_along(const Points& positions, int axis, const GhostPlan& plan) {
    const Box box = plan.periodic.value_or(Box());
    // A view of points is const, but the caller's arrays are not.
    auto* x = static_cast<T*>(const_cast<void*>(positions.axes[axis]));
    for (const Shift& shift : plan.shifts) {
        *x = image_outside(*x, box, axis, shift[axis]);
        x += &shift == &plan.shifts.back() ? 0 : positions.stride / sizeof(T);
    }
}

}  // namespace

void detail::apply_shifts(const GhostPlan& plan, const Points& positions) {
    if (plan.shifts.empty()) return;
    require(positions.count == plan.shifts.size(), "positions must have an entry for each ghost");
    check_layout(positions);
    for (int a = 0; a < positions.dimension; ++a) {
        if (positions.type == ScalarType::float32)
            apply_shifts_along<float>(positions, a, plan);
        else
            apply_shifts_along<double>(positions, a, plan);
    }
}

void apply_shifts(const GhostPlan& plan, std::span<double> positions) {
    apply_shifts_to(positions, plan);
}

void apply_shifts(const GhostPlan& plan, std::span<float> positions) {
    apply_shifts_to(positions, plan);
}

}  // namespace rrcb
