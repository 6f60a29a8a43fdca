#pragma once

#include "lists/rows.hpp"

#include <rrcb/transfer.hpp>

#include <cstddef>
#include <span>

namespace rrcb {

/// Returns the number of bytes of one row of a column.
inline std::size_t row_bytes(const detail::ByteColumn& column) {
    return column.components * column.value_bytes;
}

/// Returns the number of bytes of a block of rows in a message. It is a multiple of the alignment
/// of all numbers.
inline std::size_t block_bytes(std::size_t row_bytes, std::size_t num_rows) {
    constexpr std::size_t alignment = 16;
    return (row_bytes * num_rows + alignment - 1) / alignment * alignment;
}

/// Returns the number of bytes of a message that has a block of rows for each column.
inline std::size_t message_bytes(std::span<const detail::ByteColumn> columns,
                                 std::size_t num_rows) {
    std::size_t bytes = 0;
    for (const detail::ByteColumn& column : columns)
        bytes += block_bytes(row_bytes(column), num_rows);
    return bytes;
}

/// Writes the rows of some points, one block for each column.
inline void pack(std::span<const detail::ByteColumn> columns, std::span<const LocalIndex> points,
                 std::byte* place) {
    for (const detail::ByteColumn& column : columns) {
        gather(column.from, row_bytes(column), points, place);
        place += block_bytes(row_bytes(column), points.size());
    }
}

}  // namespace rrcb
