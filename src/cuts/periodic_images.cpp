#include "cuts/periodic_images.hpp"

#include "collective/mix.hpp"
#include "options/rejection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rrcb {

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
        require(radius / most_periods <= period, "a radius must be at most 100 periods");
    }
}

Vector PeriodicImages::apart(const Vector& x) const {
    Vector apart{};
    for (int a = 0; a < dimension_; ++a)
        apart[a] = std::max({0.0, box_.lower[a] - x[a], x[a] - box_.upper[a]});
    return apart;
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
            hash = mix(hash ^ std::bit_cast<std::uint64_t>(end + 0.0));
    return hash;
}

}  // namespace rrcb
