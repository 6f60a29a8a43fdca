#pragma once

#include <cstdint>
#include <cstring>

namespace mpm {

/// Two consecutive values of a column. Any 64-bit processor computes with both at once.
using Pair [[gnu::vector_size(16)]] = double;

/// Result of a comparison of pairs: all bits are set if it is true, and none if it is false.
using PairMask [[gnu::vector_size(16)]] = std::int64_t;

[[gnu::always_inline]] inline Pair load_pair(const double* from) {
    Pair pair;
    std::memcpy(&pair, from, sizeof(pair));
    return pair;
}

}  // namespace mpm

/// Compiles a function a second time, for processors with vectors of four doubles.
///
/// The loader selects the version for the processor. The compiler neither fuses nor reorders
/// operations, so both versions compute bit-identical results.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define MPM_VECTOR_CLONES [[gnu::target_clones("default", "avx2")]]
#else
#define MPM_VECTOR_CLONES
#endif
