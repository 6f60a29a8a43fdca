#pragma once

#include <cstddef>
#include <utility>

namespace mpm {

/// Calls visit(std::integral_constant<std::size_t, i>) for i below N, with no loop left over.
template <std::size_t N, typename Visit>
[[gnu::always_inline]] inline void unrolled(Visit&& visit) {
    [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
        (visit(std::integral_constant<std::size_t, i>{}), ...);
    }
    (std::make_index_sequence<N>{});
}

constexpr std::size_t power(std::size_t base, std::size_t exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

}  // namespace mpm
