#pragma once

#include "c/balancer.hpp"

#include <rrcb/transfer.hpp>

#include <cstddef>
#include <vector>

namespace rrcb::c {

/// Returns columns as the library moves them. Throws Error for unknown types, and if a column of
/// `num_points` points is null.
std::vector<detail::ByteColumn> columns_of(std::span<const rrcb_column> columns,
                                           LocalIndex num_points);

/// Returns a view of the columns of a call. Throws Error if they are null.
std::span<const rrcb_column> given_columns(const rrcb_column* columns, std::size_t count);

/// Returns the limits of a call, the default if they are null.
TransferLimits limits_of(const rrcb_transfer_limits* limits);

/// Writes a report, unless it is null.
void store(const TransferReport& from, rrcb_transfer_report* report);

}  // namespace rrcb::c
