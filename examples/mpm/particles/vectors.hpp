#pragma once

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

/// Compiles a function a second time for processors with vectors of four doubles.
///
/// The loader takes the one that fits the processor. The compiler fuses and reorders no operation,
/// so both give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define MPM_VECTOR_CLONES [[gnu::target_clones("default", "avx2")]]
#else
#define MPM_VECTOR_CLONES
#endif
