#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace mpm {

/// Two neighbours of a column; any 64-bit processor takes them at once.
using Pair [[gnu::vector_size(16)]] = double;

/// Result of a comparison of pairs: all bits set where it holds, else none.
using PairMask [[gnu::vector_size(16)]] = std::int64_t;

[[gnu::always_inline]] inline Pair load_pair(const double* from) {
    Pair pair;
    std::memcpy(&pair, from, sizeof(pair));
    return pair;
}

}  // namespace mpm
