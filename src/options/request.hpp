#pragma once

#include "options/option_table.hpp"

#include <rrcb/cuts.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rrcb {

/// Number of options that ranks compare by themselves.
inline constexpr std::size_t num_compared = [] {
    std::size_t count = 0;
    for (const Option& option : option_table) count += is_compared(option) ? 1 : 0;
    return count;
}();

/// Request of a rank, which must be the same on every rank: the bits of each value, or a hash. It
/// contains the dimension, every compared option in the order of the table, the cuts of an earlier
/// call, and the arithmetic of this thread.
using Request = std::array<std::uint64_t, num_compared + 3>;

/// Returns a number that shows how this thread rounds and treats subnormal numbers. Ranks with
/// different ones get different results from the same operands.
std::uint64_t arithmetic_in_use();

inline constexpr std::string_view name_of_arithmetic =
    "the floating-point environment (rounding, subnormal numbers)";

/// Returns a hash of numbers and their count.
std::uint64_t hash_of(std::span<const double> values);

/// Returns a hash of the number of points and the first, middle and last position, never 0.
std::uint64_t hash_of(const Points& points);

/// Returns the value of Cuts::points: the same hash if one of the points has to leave `rank` for
/// its part, otherwise 0.
std::uint64_t hash_if_leaving(const Points& points, std::span<const Part> parts, int num_parts,
                              int rank, int num_ranks);

/// Returns the bits of one option, or a hash.
std::uint64_t bits_of(const Option& option, const Options& options);

/// Returns a hash of cuts.
std::uint64_t bits_of(const Cuts& cuts);

/// Returns the request of options, in which empty `part_sizes` still stand for equal parts.
Request request_of(const Options& options, int dimension, const Cuts* previous);

/// Returns the index of the first value that differs.
std::optional<std::size_t> first_difference(const Request& a, const Request& b);

/// Returns the name of a value.
std::string_view name_of_request(std::size_t index);

}  // namespace rrcb
