#pragma once

/// Compiles a function a second time for processors with vectors of four doubles; the loader takes
/// what fits. No operations are fused and none change places, so that the bits are the same.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define MPM_VECTOR_CLONES [[gnu::target_clones("default", "avx2")]]
#else
#define MPM_VECTOR_CLONES
#endif
