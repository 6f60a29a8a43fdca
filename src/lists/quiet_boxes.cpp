#include "lists/quiet_boxes.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/vector_clones.hpp"
#include "cuts/tree.hpp"
#include "lists/periodic_images.hpp"
#include "passes/point_layout.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace rrcb {

namespace {

/// Returns a bound such that every x above it has x - face > reach in rounded arithmetic. The bound
/// is only a few doubles larger than necessary. `scale` bounds the size of the operands.
double beyond(double face, double reach, double scale) {
    if (face == -infinity) return -infinity;
    const double margin = 4 * std::numeric_limits<double>::epsilon() * scale;
    const double x = std::nextafter(face + reach + margin, infinity);
    // A rounded difference never decreases while x increases.
    return x - face > reach ? x : infinity;
}

/// Returns the bound above which the images of points, shifted up by one period, are beyond reach
/// of the box. Returns -infinity if the axis is not periodic.
double beyond_images(double reach, const Box& box, int axis) {
    const double lower = box.lower[axis];
    const double upper = box.upper[axis];
    if (lower == -infinity) return -infinity;
    const double x = beyond(lower, reach, std::abs(lower) + std::abs(upper) + reach);
    return image_of(x, box, axis, 1) - upper > reach ? x : infinity;
}

Box mirrored(const Box& box) {
    Box mirror;
    for (std::size_t a = 0; a < max_dimension; ++a) {
        mirror.lower[a] = -box.upper[a];
        mirror.upper[a] = -box.lower[a];
    }
    return mirror;
}

/// Returns the lower ends of a quiet box in the box `home`.
Vector lower_of(const Box& home, double reach, int dimension, const Box& periodic) {
    Vector lower{};
    for (int a = 0; a < dimension; ++a)
        lower[a] = std::max(beyond(home.lower[a], reach, std::max(std::abs(home.lower[a]), reach)),
                            beyond_images(reach, periodic, a));
    return lower;
}

template <class Layout>
bool is_inside(const Layout& x, LocalIndex i, const Box& box) {
    for (int a = 0; a < Layout::dimension; ++a)
        if (!(x(i, a) > box.lower[a] && x(i, a) < box.upper[a])) return false;
    return true;
}

/// Returns whether all points of a block are in an open box. Has no branches, so that the compiler
/// compares several points at a time. In columns that costs less than half of a test of each point.
template <int Dimension, class Scalar>
RRCB_VECTOR_CLONES bool are_inside(const ColumnLayout<Dimension, Scalar>& x, LocalIndex first,
                                   LocalIndex last, const Box& box) {
    std::int64_t outside = 0;
    for (int a = 0; a < Dimension; ++a) {
        const double lower = box.lower[a];
        const double upper = box.upper[a];
        for (LocalIndex i = first; i < last; ++i)
            outside |= static_cast<std::int64_t>(!(x(i, a) > lower)) |
                       static_cast<std::int64_t>(!(x(i, a) < upper));
    }
    return outside == 0;
}

/// Other layouts gain nothing from a test of all points, so each point is tested.
template <class Layout>
bool are_inside(const Layout&, LocalIndex, LocalIndex, const Box&) {
    return false;
}

}  // namespace

QuietBoxes::QuietBoxes(std::span<const Box> homes, double radius, int dimension,
                       const PeriodicImages* images) {
    if (radius < 0) {
        boxes_.push_back(everywhere);
        return;
    }
    const double reach = Ball::reach_of(radius);
    const Box periodic = images != nullptr ? images->box() : everywhere;
    for (const Box& home : homes) {
        Box quiet;
        quiet.lower = lower_of(home, reach, dimension, periodic);
        quiet.upper = lower_of(mirrored(home), reach, dimension, mirrored(periodic));
        bool is_empty = false;
        for (int a = 0; a < dimension; ++a) {
            quiet.upper[a] = -quiet.upper[a];
            is_empty = is_empty || !(quiet.lower[a] < quiet.upper[a]);
        }
        if (!is_empty) boxes_.push_back(quiet);
    }
}

LocalIndex QuietBoxes::list_outside(const Points& points, LocalIndex first, LocalIndex last,
                                    LocalIndex* outside) const {
    if (boxes_.empty()) {
        std::iota(outside, outside + (last - first), first);
        return last - first;
    }
    return visit_layout(points, [&](const auto& x) {
        LocalIndex number = 0;
        const Box front = boxes_.front();
        if (are_inside(x, first, last, front)) return LocalIndex{0};
        for (LocalIndex i = first; i < last; ++i)
            if (!is_inside(x, i, front)) outside[number++] = i;
        for (const Box& box : std::span(boxes_).subspan(1)) {
            const auto left = std::remove_if(outside, outside + number,
                                             [&](LocalIndex i) { return is_inside(x, i, box); });
            number = static_cast<LocalIndex>(left - outside);
        }
        return number;
    });
}

}  // namespace rrcb
