#pragma once

#include <rrcb/points.hpp>

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

namespace rrcb {

inline void copy_bytes(const std::byte* from, std::size_t bytes, std::byte* to) {
    if (bytes > 0) std::memcpy(to, from, bytes);
}

/// Calls by(bytes). Common numbers of bytes are passed as compile-time constants, which is faster.
template <class By>
void with_row_bytes(std::size_t bytes, By&& by) {
    switch (bytes) {
        case 8:
            return by(std::integral_constant<std::size_t, 8>{});
        case 16:
            return by(std::integral_constant<std::size_t, 16>{});
        case 24:
            return by(std::integral_constant<std::size_t, 24>{});
        default:
            return by(bytes);
    }
}

/// Copies the rows of some points. Each row has `row_bytes` bytes.
inline void gather(const std::byte* from, std::size_t row_bytes, std::span<const LocalIndex> points,
                   std::byte* to) {
    with_row_bytes(row_bytes, [&](auto bytes) {
        for (const LocalIndex point : points) {
            copy_bytes(from + point * bytes, bytes, to);
            to += bytes;
        }
    });
}

}  // namespace rrcb
