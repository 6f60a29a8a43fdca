#pragma once

#include <rrcb/cuts.hpp>
#include <rrcb/options.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace rrcb {

/// What the options can be told apart by, and the arithmetic, in the order of the comparison.
inline constexpr std::array<std::string_view, 15> request_names = {
    "dimension",
    "num_parts",
    "part_sizes",
    "support_mesh",
    "domain",
    "cut_rule",
    "one of grouped_axes, cut_axes, plain_cuts",
    "previous",
    "refine",
    "coincident",
    "imbalance_tolerance",
    "sigma_multiplier",
    "sample_fraction",
    "seed",
    "the floating-point environment (rounding, subnormal numbers)"};

/// What a rank asks for, which must be the same on every rank: the bits of each value, or a hash.
using Request = std::array<std::uint64_t, request_names.size()>;

/// Of options in which empty `part_sizes` still stand for equal parts.
Request request_of(const Options& options, int dimension, const Cuts* previous);

/// Index in `request_names` of the first value in which two ranks differ.
std::optional<std::size_t> first_difference(const Request& a, const Request& b);

}  // namespace rrcb
