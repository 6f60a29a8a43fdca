#pragma once

#include "collective/participant.hpp"

#include <rrcb/transfer.hpp>

#include <cstdint>
#include <span>
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

/// Count by which a rank tells the others that it has failed.
inline constexpr std::int64_t failed_there = -1;

/// Turns the counts that go to each rank into those that come from each, `per_rank`.
///
/// Collective: each pair of ranks exchanges a number.
void exchange_counts(std::span<const RankCount> to, std::span<std::int64_t> per_rank,
                     const Participant& self);

/// Throws Error unless ranks ascend and are below `num_ranks`, and counts add up to `total`.
void check_counts(std::span<const RankCount> counts, LocalIndex total, int num_ranks);

/// Moves columns into their results; `per_rank` is to work with.
///
/// Collective: a number for each pair of ranks, one reduction, then the messages. What went wrong
/// on a rank before is told to all.
void deliver(const Delivery& delivery, std::span<const detail::ByteColumn> columns,
             const TransferLimits& limits, TransferReport* report, std::span<std::int64_t> per_rank,
             Participant& self);

}  // namespace rrcb
