#pragma once

#include "collective/participant.hpp"

#include <rrcb/transfer.hpp>

#include <span>
#include <string>
#include <vector>

namespace rrcb {

/// Points of this rank that are sent and that come.
struct Delivery {
    LocalIndex num_points = 0;              ///< that this rank holds
    LocalIndex num_kept = 0;                ///< of them, which come first in the result
    std::span<const LocalIndex> removed{};  ///< ascending: all others are kept, if any
    std::span<const LocalIndex> sent{};     ///< for one rank after the other
    std::vector<RankCount> to{};            ///< how many of them; ranks ascending
    std::vector<RankCount> from{};
};

/// Throws Error unless ranks ascend and are below `num_ranks`, and counts add up to `total`.
void check_counts(std::span<const RankCount> counts, LocalIndex total, int num_ranks);

/// Throws Error unless a column holds its components for each of `count` points or other `entries`.
void check_column(const detail::ByteColumn& column, LocalIndex count, const std::string& entries);

/// Moves columns into their results.
///
/// Collective as exchange_counts() is, then one reduction and the messages. An earlier failure on
/// one rank is thrown on all.
void deliver(const Delivery& delivery, std::span<const detail::ByteColumn> columns,
             const TransferLimits& limits, TransferReport* report, Participant& self);

}  // namespace rrcb
