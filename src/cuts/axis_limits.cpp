#include "cuts/axis_limits.hpp"

#include "arithmetic/double_order.hpp"
#include "arithmetic/infinity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rrcb {

namespace {

/// Returns the least double above `from` for which `holds` is true; it must be true for all larger
/// ones as well. A `guess` near the result saves steps.
template <class Holds>
double least_double(double from, double guess, Holds&& holds) {
    for (const double x : {guess, std::nextafter(guess, infinity)})
        if (holds(x) && !holds(std::nextafter(x, -infinity))) return x;
    std::int64_t below = double_rank(from);
    std::int64_t at = double_rank(infinity);
    // Invariant: the result is in (below, at].
    while (at - 1 > below) {
        const std::int64_t middle = below / 2 + at / 2 + (below % 2 + at % 2) / 2;
        (holds(double_of_rank(middle)) ? at : below) = middle;
    }
    return double_of_rank(at);
}

}  // namespace

bool AxisLimits::is_apart(double lower, double upper) const {
    return upper > lower && upper - lower >= min_width_;
}

bool AxisLimits::resolves(double magnitude) const {
    return grid_.spacing >= 0x1p-50 * std::max(magnitude, std::abs(grid_.origin));
}

double AxisLimits::line(double k) const {
    return grid_.origin + k * grid_.spacing;
}

double AxisLimits::line_below(double value) const {
    // Divides before subtracting, because the difference might overflow.
    double k = std::floor(value / grid_.spacing - grid_.origin / grid_.spacing);
    // The number of a line times the spacing must not overflow.
    constexpr double most = std::numeric_limits<double>::max();
    const double last = grid_.spacing < 1 ? most : std::floor(most / grid_.spacing);
    k = std::clamp(k, -last, last);
    // Corrects the rounding of the quotients.
    while (line(k) > value) --k;
    while (line(k + 1) <= value) ++k;
    return k;
}

double AxisLimits::next_behind(double face) const {
    if (!has_grid())
        return least_double(face, std::max(face + min_width_, std::nextafter(face, infinity)),
                            [&](double x) { return is_apart(face, x); });
    // The grid resolves() the points, so that so wide a box would not fit between them.
    if (!(min_width_ / grid_.spacing < 0x1p52)) return infinity;
    double k = line_below(std::min(face + min_width_, std::numeric_limits<double>::max()));
    while (is_apart(face, line(k))) --k;
    while (!is_apart(face, line(k))) ++k;
    return line(k);
}

double AxisLimits::place_behind(double value) const {
    return AxisLimits(0, grid_).next_behind(value);
}

double AxisLimits::place_before(double value) const {
    return -mirrored().place_behind(-value);
}

double AxisLimits::first_behind(double face, int count) const {
    for (int k = 0; k < count && face < infinity; ++k) face = next_behind(face);
    return face;
}

double AxisLimits::last_before(double face, int count) const {
    return -mirrored().first_behind(-face, count);
}

int AxisLimits::count_between(double lower, double upper, int most) const {
    int count = 1;
    while (count < most && is_apart(lower = next_behind(lower), upper)) ++count;
    return count;
}

double AxisLimits::nearest(double value, double first, double last) const {
    value = std::clamp(value, first, last);
    if (!has_grid() || value == first || value == last) return value;
    const double k = line_below(value);
    const double above = line(k + 1);
    return value - line(k) <= above - value ? line(k) : above;
}

}  // namespace rrcb
