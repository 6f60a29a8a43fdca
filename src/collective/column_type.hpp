#pragma once

#include <rrcb/transfer.hpp>

#include <array>
#include <cstdint>
#include <string>

namespace rrcb {

/// Number of components, bytes and kind of the values of a column, as one number. It must be the
/// same on every rank.
using ColumnType = std::uint64_t;

inline ColumnType type_of(const detail::ByteColumn& column) {
    return std::uint64_t{column.components} << 32 | std::uint64_t{column.value_bytes} << 2 |
           static_cast<std::uint64_t>(column.kind);
}

inline std::string text_of_type(ColumnType type) {
    constexpr std::array kinds{"whole numbers", "floating-point numbers", "values of another type",
                               "values"};
    return std::to_string(type >> 32) + " per point, " + kinds.at(type & 3) + " of " +
           std::to_string((type & 0xffffffff) >> 2) + " bytes";
}

}  // namespace rrcb
