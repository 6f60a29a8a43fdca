#pragma once

#include "options/option_table.hpp"

#include <rrcb/cuts.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rrcb {

/// Number of options that are compared between ranks by themselves.
inline constexpr std::size_t num_compared = [] {
    std::size_t count = 0;
    for (const Option& option : option_table) count += is_compared(option) ? 1 : 0;
    return count;
}();

/// Request of a rank, which must be the same on every rank: the bits of each value, or a hash. It
/// holds the dimension, every option that is compared in the order of the table, the cuts of an
/// earlier call, and how this thread does arithmetic.
using Request = std::array<std::uint64_t, num_compared + 3>;

/// Number for how this thread rounds and treats subnormal numbers, found out by computing. Ranks
/// with different numbers get different results from the same operands.
std::uint64_t arithmetic_in_use();

inline constexpr std::string_view name_of_arithmetic =
    "the floating-point environment (rounding, subnormal numbers)";

/// Hash of numbers and how many they are.
std::uint64_t hash_of(std::span<const double> values);

/// The bits of one option, or a hash.
std::uint64_t bits_of(const Option& option, const Options& options);

/// Hash of cuts; of those that are spread over the ranks, that they are.
std::uint64_t bits_of(const Cuts& cuts);

/// Request of options in which empty `part_sizes` still stand for equal parts.
Request request_of(const Options& options, int dimension, const Cuts* previous);

/// Index of the first value in which two ranks differ.
std::optional<std::size_t> first_difference(const Request& a, const Request& b);

/// Name of a value of a request.
std::string_view name_of_request(std::size_t index);

}  // namespace rrcb
