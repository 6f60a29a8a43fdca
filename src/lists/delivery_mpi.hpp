#pragma once

#include "collective/participant.hpp"

#include <rrcb/transfer.hpp>

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace rrcb {

/// Points that this rank keeps, sends and receives. The lists are borrowed.
struct Delivery {
    LocalIndex num_points = 0;  ///< points that this rank has before
    LocalIndex num_kept = 0;    ///< points of these that it keeps; they come first in the result
    std::span<const LocalIndex> removed{};  ///< points that it does not keep, ascending; needed if
                                            ///< any are kept
    std::span<const LocalIndex> sent{};  ///< points to send, sorted by rank; empty: all, in their
                                         ///< order
    std::span<const RankCount> to{};     ///< number of points for each rank, ascending
    std::span<const RankCount> from{};
    std::uint64_t overtaking = 0;  ///< number of the transfer that made the plan stale; the call
                                   ///< fails if it is the same on all ranks and not 0
    bool is_in_place = false;  ///< whether results are the columns themselves, which keep all their
                               ///< rows
};

/// Memory for the result of a column whose type is not known here.
struct ByteResult {
    std::size_t value_bytes;
    std::vector<std::byte> bytes{};

    /// Returns the column with this memory as its result.
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

/// Returns the sum of the counts.
LocalIndex total(std::span<const RankCount> counts);

/// Throws Error unless the ranks ascend and are below `num_ranks`, and the counts add up to
/// `total`.
void check_counts(std::span<const RankCount> counts, LocalIndex total, int num_ranks);

/// Throws Error unless a column has a row for each of `count` entries. `entries` names them in the
/// text.
void check_column(const detail::ByteColumn& column, LocalIndex count, std::string_view entries);

/// Throws Error if two columns have the same array as their result.
void check_results(std::span<const detail::ByteColumn> columns);

/// Result of deliver().
struct Delivered {
    bool moves = false;  ///< whether any rank sends points
    bool fits = false;   ///< whether on all ranks each message fits into the limits as one piece
    bool is_like_before = false;  ///< whether hash_of(points) may be the same as before
};

/// Moves the rows of columns into their results.
///
/// Collective: exchange_counts(), one reduction and the messages. If a rank has failed before, all
/// ranks throw its error.
Delivered deliver(const Delivery& delivery, std::span<const detail::ByteColumn> columns,
                  const TransferOptions& options, Participant& self);

}  // namespace rrcb
