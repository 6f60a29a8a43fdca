#pragma once

// These macros compile a function additionally for processors with longer vectors; the loader
// selects one version. All versions must return the same bits. RRCB_VECTOR_CLONES is therefore only
// for functions that compare and select. RRCB_ARITHMETIC_CLONES leaves out instruction sets with
// fused multiply-adds, which round once instead of twice.
#if defined(__x86_64__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define RRCB_VECTOR_CLONES [[gnu::target_clones("default", "avx2", "arch=x86-64-v4")]]
#define RRCB_ARITHMETIC_CLONES [[gnu::target_clones("default", "avx2")]]
#else
#define RRCB_VECTOR_CLONES
#define RRCB_ARITHMETIC_CLONES
#endif
