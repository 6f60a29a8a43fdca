#pragma once

#include "collective/participant.hpp"

#include <rrcb/transfer.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace rrcb {

/// Points kept, sent and received by this rank; borrows the lists.
struct Delivery {
    LocalIndex num_points = 0;              ///< that this rank holds
    LocalIndex num_kept = 0;                ///< of these, first in the result
    std::span<const LocalIndex> removed{};  ///< ascending; if any are kept, all others
    std::span<const LocalIndex> sent{};     ///< sorted by rank; empty: all, in their order
    std::span<const RankCount> to{};        ///< number for each rank, ascending
    std::span<const RankCount> from{};
    std::uint64_t overtaking = 0;  ///< number of a transfer; if the same on all ranks, refused
    bool is_in_place = false;      ///< results are the columns themselves, all of which are kept
};

/// Memory for the result of a column whose type is not known.
struct ByteResult {
    std::size_t value_bytes;
    std::vector<std::byte> bytes{};

    /// Returns the column with this as its result.
    detail::ByteColumn result_of(detail::ByteColumn column) {
        column.result = this;
        column.resize = [](void* result, std::size_t num_values) {
            auto& values = *static_cast<ByteResult*>(result);
            values.bytes.resize(num_values * values.value_bytes);
            return values.bytes.data();
        };
        return column;
    }
};

/// Returns the number of points to or from all ranks.
LocalIndex total(std::span<const RankCount> counts);

/// Throws Error unless ranks ascend and are below `num_ranks`, and counts add up to `total`.
void check_counts(std::span<const RankCount> counts, LocalIndex total, int num_ranks);

/// Throws Error unless a column holds its components for each of `count` points or other `entries`.
void check_column(const detail::ByteColumn& column, LocalIndex count, std::string_view entries);

/// Throws Error if two columns have the same array as their result.
void check_results(std::span<const detail::ByteColumn> columns);

/// Result of deliver().
struct Delivered {
    bool moves = false;           ///< whether any rank sends points
    bool fits = false;            ///< whether whole messages are within the limits on all ranks
    bool is_like_before = false;  ///< the points that hash_of(points) reads may be as before
};

/// Moves columns into their results.
///
/// Collective: exchange_counts(), one reduction and the messages. An earlier failure on one rank is
/// thrown on all.
Delivered deliver(const Delivery& delivery, std::span<const detail::ByteColumn> columns,
                  const TransferLimits& limits, TransferReport* report, Participant& self);

}  // namespace rrcb
