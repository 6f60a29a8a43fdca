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
/// contains the dimension, every compared option in the order of the table, the cuts of an earlier
/// call, and the arithmetic of this thread.
using Request = std::array<std::uint64_t, num_compared + 3>;

/// Returns a number that depends on rounding and subnormal numbers in this thread, by computing.
/// Ranks with different numbers get different results from the same operands.
std::uint64_t arithmetic_in_use();

inline constexpr std::string_view name_of_arithmetic =
    "the floating-point environment (rounding, subnormal numbers)";

/// Returns a hash of numbers and their count.
std::uint64_t hash_of(std::span<const double> values);

/// Returns the bits of one option, or a hash.
std::uint64_t bits_of(const Option& option, const Options& options);

/// Returns a hash of cuts; a constant if they are spread over the ranks.
std::uint64_t bits_of(const Cuts& cuts);

/// Request of options in which empty `part_sizes` still stand for equal parts.
Request request_of(const Options& options, int dimension, const Cuts* previous);

/// Index of the first value in which two ranks differ.
std::optional<std::size_t> first_difference(const Request& a, const Request& b);

/// Name of a value of a request.
std::string_view name_of_request(std::size_t index);

}  // namespace rrcb
