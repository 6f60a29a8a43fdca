#include "zoltan/norm/multicriteria.hpp"

#include <algorithm>
#include <cmath>

namespace rrcb::zoltan {

namespace {

double norm_of(int norm, const Factors& values) {
    double sum = 0;
    double largest = 0;
    for (const double value : values) {
        sum += norm == 2 ? value * value : value;
        largest = std::max(largest, value);
    }
    if (norm == 1) return sum;
    return norm == 2 ? std::sqrt(sum) : largest;
}

Factors scaled(const Factors& factors, const Load& load) {
    Factors values{};
    for (std::size_t k = 0; k < values.size(); ++k)
        values[k] = factors[k] * static_cast<double>(load[k]);
    return values;
}

/// Share of one weight, bounded away from 0 and 1 as in Zoltan: other weights may have shares
/// between.
double usable(double share) {
    constexpr double least = 0.001;
    if (share <= 0) return least;
    return share >= 1 ? 1 - least : share;
}

}  // namespace

Load operator+(const Load& a, const Load& b) {
    Load sum{};
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] = a[k] + b[k];
    return sum;
}

Load operator-(const Load& a, const Load& b) {
    Load rest{};
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] = a[k] - b[k];
    return rest;
}

double norm_below(const Aim& aim, const Load& below) {
    return norm_of(aim.norm, scaled(aim.below, below));
}

double norm_above(const Aim& aim, const Load& below) {
    return norm_of(aim.norm, scaled(aim.above, aim.all - below));
}

double larger_norm(const Aim& aim, const Load& below) {
    return std::max(norm_below(aim, below), norm_above(aim, below));
}

double quality(const Aim& aim, const Load& below) {
    Factors larger = scaled(aim.below, below);
    const Factors above = scaled(aim.above, aim.all - below);
    for (std::size_t k = 0; k < larger.size(); ++k) larger[k] = std::max(larger[k], above[k]);
    return norm_of(aim.norm, larger);
}

Aim aim_of(int norm, const Factors& values, const std::array<double, most_weights>& shares,
           const Load& all) {
    Aim aim{norm, {}, {}, all};
    bool weighs = false;
    for (std::size_t k = 0; k < most_weights; ++k) {
        weighs = weighs || (values[k] > 0 && all[k] > 0);
        aim.below[k] = values[k] / usable(shares[k]);
        aim.above[k] = values[k] / (1 - usable(shares[k]));
    }
    if (weighs) return aim;
    aim.below[most_weights] = 1 / usable(shares[0]);
    aim.above[most_weights] = 1 / (1 - usable(shares[0]));
    return aim;
}

std::size_t find_slot(const Aim& aim, std::span<const Load> slots, Load& base) {
    for (std::size_t s = 0; s + 1 < slots.size(); ++s) {
        const Load end = base + slots[s];
        if (norm_below(aim, end) >= norm_above(aim, end)) return s;
        base = end;
    }
    return slots.size() - 1;
}

}  // namespace rrcb::zoltan
