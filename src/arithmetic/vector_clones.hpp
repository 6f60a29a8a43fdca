#pragma once

// Compile a function also for processors with longer vectors; the loader selects one version.
// The results are the same: RRCB_VECTOR_CLONES is for functions that only compare and select.
// RRCB_ARITHMETIC_CLONES omits instruction sets with fused multiply-adds, which round once.
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RRCB_VECTOR_CLONES [[gnu::target_clones("default", "avx2", "arch=x86-64-v4")]]
#define RRCB_ARITHMETIC_CLONES [[gnu::target_clones("default", "avx2")]]
#else
#define RRCB_VECTOR_CLONES
#define RRCB_ARITHMETIC_CLONES
#endif
