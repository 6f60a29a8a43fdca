#include "bisection/profile.hpp"

#include "arithmetic/infinity.hpp"
#include "arithmetic/vector_clones.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace rrcb {

namespace {

constexpr std::size_t lanes = std::tuple_size_v<Profile::Lanes>;
typedef double Row __attribute__((vector_size(sizeof(Profile::Lanes))));

[[gnu::always_inline]] inline void load(const Profile::Lanes& values, Row& row) {
    std::memcpy(&row, values.data(), sizeof row);
}

double sum_of(const Row& row) {
    return (row[0] + row[1]) + (row[2] + row[3]);
}

/// Weight below a value, and density there over half lengths.
struct Reading {
    double below = 0;
    double density = 0;
};

/// Reads the cumulative weight at twice `half`, without branches.
RRCB_ARITHMETIC_CLONES Reading read(std::span<const Profile::Block> blocks, double half) {
    const Row zero{};
    const Row one = zero + 1;
    Row below{};
    Row density{};
    for (const Profile::Block& block : blocks) {
        Row lower, inverse, weight, slope, bow;
        load(block.half_lower, lower);
        load(block.inverse, inverse);
        load(block.weight, weight);
        load(block.slope, slope);
        load(block.bow, bow);
        const Row offset = (half - lower) * inverse;
        const Row from = offset > zero ? offset : zero;
        const Row t = from < one ? from : one;
        const Row u = t + t - one;
        const Row tilt = slope + bow * u;
        const Row rest = (one - t) * t;
        below += weight * (t - rest * tilt);
        const Row across = rest > zero ? weight * inverse : zero;
        density += across * (one + u * tilt - 2 * rest * bow);
    }
    return {sum_of(below), sum_of(density)};
}

}  // namespace

void Profile::take(const StatisticalDomain& domain, int axis) {
    constexpr double largest = std::numeric_limits<double>::max();
    const auto a = static_cast<std::size_t>(axis);
    const std::size_t size = domain.patches.size();
    blocks_.resize((size + lanes - 1) / lanes);
    if (size % lanes > 0) blocks_.back() = Block{};
    double lower = infinity;
    double upper = -infinity;
    double weight = 0;
    auto block = blocks_.begin();
    std::size_t k = 0;
    for (const Patch& patch : domain.patches) {
        const double half = patch.upper[a] / 2 - patch.lower[a] / 2;
        block->half_lower[k] = patch.lower[a] / 2;
        block->inverse[k] = half > 0 ? std::min(1 / half, largest) : largest;
        block->weight[k] = patch.weight;
        block->slope[k] = patch.slope[a];
        block->bow[k] = patch.bow[a];
        weight += patch.weight;
        lower = std::min(lower, patch.lower[a]);
        upper = std::max(upper, patch.upper[a]);
        k = (k + 1) % lanes;
        if (k == 0) ++block;
    }
    domain_ = &domain;
    axis_ = axis;
    lower_ = lower;
    upper_ = upper;
    weight_ = weight;
}

double Profile::weight_below(double value) const {
    return read(blocks_, value / 2).below;
}

double Profile::weight_within(double value, double reach) const {
    return weight_below(value + reach) - weight_below(value - reach);
}

double Profile::weight_near(double value, double reach) const {
    if (!std::isfinite(value)) return weight_;
    return reach > 0 ? weight_within(value, reach) : weight_ / (upper_ / 2 - lower_ / 2);
}

Profile::Range Profile::range_of(double target, double error, int most_steps) const {
    Range range;
    double left = lower_ / 2;
    double right = upper_ / 2;
    double from = 0;
    double to = weight_;
    double half = std::lerp(left, right, target / weight_);
    for (int step = 0; step < most_steps && left < half && half < right; ++step) {
        const auto [below, density] = read(blocks_, half);
        const double excess = below - target;
        if (std::abs(excess) <= error) {
            range.value = 2 * half;
            break;
        }
        const bool is_left = excess < 0;
        (is_left ? left : right) = half;
        (is_left ? from : to) = below;
        (is_left ? range.lower : range.upper) = 2 * half;
        half -= excess / std::max(density, std::numeric_limits<double>::min());
        if (left < half && half < right) continue;
        half = step % 2 == 0 ? std::lerp(left, right, (target - from) / (to - from))
                             : left / 2 + right / 2;
    }
    return range;
}

bool Profile::grows_at(double value, double error) const {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const auto [below, density] = read(blocks_, value / 2);
    const double aside = std::max(4 * error / density, 4 * epsilon * std::abs(value / 2));
    return density > 0 && below - read(blocks_, value / 2 - aside).below > error &&
           read(blocks_, value / 2 + aside).below - below > error;
}

}  // namespace rrcb
