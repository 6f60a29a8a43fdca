#include "options/request.hpp"

#include "options/arithmetic.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace rrcb {

namespace {

std::uint64_t bits_of(double value) {
    return std::bit_cast<std::uint64_t>(value);
}

std::uint64_t bits_of(int value) {
    return static_cast<std::uint64_t>(value);
}

std::uint64_t hash_of(std::span<const double> values) {
    std::uint64_t hash = values.size();
    for (const double value : values) {
        hash = (hash ^ bits_of(value)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

std::vector<double> axis_options(const Options& options) {
    std::vector<double> values{options.plain_cuts ? 1.0 : 0.0};
    values.insert(values.end(), options.grouped_axes.begin(), options.grouped_axes.end());
    values.push_back(-1);
    values.insert(values.end(), options.cut_axes.begin(), options.cut_axes.end());
    return values;
}

std::vector<double> values_of(const Cuts& cuts) {
    std::vector<double> values;
    for (const Cut& cut : cuts.tree) {
        values.push_back(cut.axis);
        values.insert(values.end(), cut.at.begin(), cut.at.end());
    }
    return values;
}

}  // namespace

Request request_of(const Options& options, int dimension, const Cuts* previous) {
    return {bits_of(dimension),
            bits_of(options.num_parts),
            hash_of(options.part_sizes),
            bits_of(options.support_mesh),
            bits_of(static_cast<int>(options.domain)),
            bits_of(static_cast<int>(options.cut_rule)),
            hash_of(axis_options(options)),
            previous ? hash_of(values_of(*previous)) : 0,
            bits_of(static_cast<int>(options.refine)),
            bits_of(static_cast<int>(options.coincident)),
            bits_of(options.imbalance_tolerance),
            bits_of(options.sigma_multiplier),
            bits_of(options.sample_fraction),
            options.seed,
            arithmetic_in_use()};
}

std::optional<std::size_t> first_difference(const Request& a, const Request& b) {
    const auto at = std::mismatch(a.begin(), a.end(), b.begin()).first;
    if (at == a.end()) return std::nullopt;
    return static_cast<std::size_t>(at - a.begin());
}

}  // namespace rrcb
