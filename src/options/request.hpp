#pragma once

#include "options/option_table.hpp"

#include <rrcb/cuts.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rrcb {

/// Number of options that ranks compare on their own.
inline constexpr std::size_t num_compared = [] {
    std::size_t count = 0;
    for (const Option& option : option_table) count += is_compared(option) ? 1 : 0;
    return count;
}();

/// Request of a rank, which must be the same on every rank. Each entry is the bits of a value, or a
/// hash: the dimension, every compared option in the order of the table, the cuts of an earlier
/// call, and the arithmetic of this thread.
using Request = std::array<std::uint64_t, num_compared + 3>;

/// Returns a number that depends on how this thread rounds and treats subnormal numbers. Ranks with
/// different numbers would get different results from the same operands.
std::uint64_t arithmetic_in_use();

inline constexpr std::string_view name_of_arithmetic =
    "the floating-point environment (rounding, subnormal numbers)";

/// Returns a hash of numbers and their count.
std::uint64_t hash_of(std::span<const double> values);

/// Returns a hash of the number of points and of the first, middle and last position. Never returns
/// 0.
std::uint64_t hash_of(const Points& points);

/// Returns the points of the stamp of cuts: hash_of(points) if at least one of the points has to
/// leave `rank` for its part, otherwise 0.
std::uint64_t hash_if_leaving(const Points& points, std::span<const Part> parts, int num_parts,
                              int rank, int num_ranks);

/// Returns the bits of one option, or a hash.
std::uint64_t bits_of(const Option& option, const Options& options);

/// Returns a hash of cuts.
std::uint64_t bits_of(const Cuts& cuts);

/// Returns the request for options. Empty `part_sizes` must still stand for equal parts.
Request request_of(const Options& options, int dimension, const Cuts* previous);

/// Returns the index of the first entry that differs, or nullopt.
std::optional<std::size_t> first_difference(const Request& a, const Request& b);

/// Returns the name of an entry.
std::string_view name_of_request(std::size_t index);

}  // namespace rrcb
