#pragma once

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
