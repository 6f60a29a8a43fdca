#include "bisection/profile.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/vector_clones.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace rrcb {

namespace {

constexpr std::size_t lanes = 4;
constexpr std::size_t arrays_per_axis = 4;
typedef double Row __attribute__((vector_size(lanes * sizeof(double))));

[[gnu::always_inline]] inline void fill(const double* values, Row& row) {
    std::memcpy(&row, values, sizeof row);
}

double sum_of(const Row& row) {
    return (row[0] + row[1]) + (row[2] + row[3]);
}

/// Numbers of four patches along an axis, stored row by row so that they are computed together.
struct Patches {
    Row lower, inverse, weight, slope, bow;
};

[[gnu::always_inline]] inline void fill(const double* weights, const double* of_axis,
                                        std::size_t stride, Patches& patches) {
    fill(weights, patches.weight);
    fill(of_axis, patches.lower);
    fill(of_axis + stride, patches.inverse);
    fill(of_axis + 2 * stride, patches.slope);
    fill(of_axis + 3 * stride, patches.bow);
}

/// Terms from which the share of each patch below a value is computed: `even` is the share of a
/// uniform density, and rest * tilt is subtracted from it because of slope and bow.
struct Shares {
    Row even, u, rest, tilt;
};

/// Computes the shares without branches. A patch without extent at the value has the offset NaN,
/// which is not above 0, so that its share is 0.
[[gnu::always_inline]] inline void find_shares(const Patches& patches, double half,
                                               Shares& shares) {
    const Row zero{};
    const Row one = zero + 1;
    const Row offset = (half - patches.lower) * patches.inverse;
    const Row from = offset > zero ? offset : zero;
    const Row t = from < one ? from : one;
    shares.even = t;
    shares.u = t + t - one;
    shares.rest = (one - t) * t;
    shares.tilt = patches.slope + patches.bow * shares.u;
}

/// Writes the cumulative weight along an axis at twice `half`, and the density there.
RRCB_ARITHMETIC_CLONES void read_patches(const double* weights, const double* of_axis,
                                         std::size_t stride, double half, double* reading) {
    const Row zero{};
    Row below{};
    Row density{};
    for (std::size_t k = 0; k < stride; k += lanes) {
        Patches patches;
        Shares shares;
        fill(weights + k, of_axis + k, stride, patches);
        find_shares(patches, half, shares);
        const auto& [even, u, rest, tilt] = shares;
        below += patches.weight * (even - rest * tilt);
        const Row across = rest > zero ? patches.weight * patches.inverse : zero;
        density += across * (1 + u * tilt - 2 * rest * patches.bow);
    }
    reading[0] = sum_of(below);
    reading[1] = sum_of(density);
}

/// Writes the cumulative weights at two values.
RRCB_ARITHMETIC_CLONES void weigh_patches(const double* weights, const double* of_axis,
                                          std::size_t stride, const double* halves, double* sums) {
    Row first{};
    Row second{};
    for (std::size_t k = 0; k < stride; k += lanes) {
        Patches patches;
        Shares shares;
        fill(weights + k, of_axis + k, stride, patches);
        find_shares(patches, halves[0], shares);
        first += patches.weight * (shares.even - shares.rest * shares.tilt);
        find_shares(patches, halves[1], shares);
        second += patches.weight * (shares.even - shares.rest * shares.tilt);
    }
    sums[0] = sum_of(first);
    sums[1] = sum_of(second);
}

}  // namespace

void Profile::take(const StatisticalDomain& domain) {
    domain_ = &domain;
    stride_ = (domain.patches.size() + lanes - 1) / lanes * lanes;
    const std::size_t length =
        (1 + arrays_per_axis * static_cast<std::size_t>(domain.dimension)) * stride_;
    if (numbers_.size() < length) numbers_.resize(length);
    for (std::size_t end = stride_; end <= length && end > 0; end += stride_)
        std::fill_n(&numbers_[end - lanes], lanes, 0.0);
    if (domain.dimension == 1) return take_patches<1>();
    if (domain.dimension == 2) return take_patches<2>();
    take_patches<3>();
}

template <std::size_t dimension>
void Profile::take_patches() {
    Box extent;
    double weight = 0;
    double sum = 0;
    double* number = numbers_.data();
    for (const Patch& patch : domain_->patches) {
        *number = patch.weight;
        double* of_axis = number++ + stride_;
        double half_sides = 0;
        for (std::size_t a = 0; a < dimension; ++a, of_axis += arrays_per_axis * stride_) {
            const double half = patch.upper[a] / 2 - patch.lower[a] / 2;
            of_axis[0] = patch.lower[a] / 2;
            of_axis[stride_] = half > 0 ? 1 / half : infinity;
            of_axis[2 * stride_] = patch.slope[a];
            of_axis[3 * stride_] = patch.bow[a];
            extent.lower[a] = std::min(extent.lower[a], patch.lower[a]);
            extent.upper[a] = std::max(extent.upper[a], patch.upper[a]);
            half_sides += half;
        }
        weight += patch.weight;
        sum += patch.weight * half_sides;
    }
    for (std::size_t a = dimension; a < max_dimension; ++a) extent.lower[a] = extent.upper[a] = 0;
    extent_ = extent;
    weight_ = weight;
    mean_half_side_ = weight > 0 && std::isfinite(sum) ? sum / dimension / weight : 0;
}

const double* Profile::numbers_of(int axis) const {
    return numbers_.data() + (1 + arrays_per_axis * static_cast<std::size_t>(axis)) * stride_;
}

Profile::Reading Profile::read(int axis, double half) const {
    std::array<double, 2> reading;
    read_patches(numbers_.data(), numbers_of(axis), stride_, half, reading.data());
    return {reading[0], reading[1]};
}

/// Returns the weights below twice each of `halves`.
std::array<double, 2> Profile::weights_below(int axis, const std::array<double, 2>& halves) const {
    std::array<double, 2> sums;
    weigh_patches(numbers_.data(), numbers_of(axis), stride_, halves.data(), sums.data());
    return sums;
}

double Profile::weight_below(int axis, double value) const {
    return read(axis, value / 2).below;
}

double Profile::weight_within(int axis, double value, double reach) const {
    const auto [below, beyond] = weights_below(axis, {(value - reach) / 2, (value + reach) / 2});
    return beyond - below;
}

double Profile::weight_near(int axis, double value, double reach) const {
    if (!std::isfinite(value)) return weight_;
    return reach > 0 ? weight_within(axis, value, reach)
                     : weight_ / (extent_.upper[axis] / 2 - extent_.lower[axis] / 2);
}

Profile::Range Profile::range_of(int axis, double target, double error, int most_steps,
                                 const Range& known) const {
    constexpr int steps_among_points = 5;  // enough, because the weight only jumps
    if (!(mean_half_side_ > 0)) most_steps = std::min(most_steps, steps_among_points);
    Range range = known;
    double left = std::max(range.lower, extent_.lower[axis]) / 2;
    double right = std::min(range.upper, extent_.upper[axis]) / 2;
    double from = 0;
    double to = weight_;
    double half = std::lerp(left, right, target / weight_);
    for (int step = 0; step < most_steps && left < half && half < right; ++step) {
        const auto [below, density] = read(axis, half);
        const double excess = below - target;
        if (std::abs(excess) <= error) {
            range.value = 2 * half;
            range.density = density;
            break;
        }
        const bool is_left = excess < 0;
        (is_left ? left : right) = half;
        (is_left ? from : to) = below;
        (is_left ? range.lower : range.upper) = 2 * half;
        half -= excess / std::max(density, std::numeric_limits<double>::min());
        if (left < half && half < right) continue;
        if (step % 2 == 0) half = std::lerp(left, right, (target - from) / (to - from));
        if (step % 2 != 0 || !(left < half && half < right)) half = left / 2 + right / 2;
    }
    return range;
}

bool Profile::grows_at(int axis, const Range& range, double target, double error) const {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const double half = range.value / 2;
    const double aside = std::max(4 * error / range.density, 4 * epsilon * std::abs(half));
    const auto [before, behind] = weights_below(axis, {half - aside, half + aside});
    return range.density > 0 && target - before > 2 * error && behind - target > 2 * error;
}

}  // namespace rrcb
