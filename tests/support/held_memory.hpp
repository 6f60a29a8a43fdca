// Memory that calls could leave behind; for programs that link memory_layer.cpp.
#pragma once

#include "memory_layer.hpp"

#include <gtest/gtest.h>

#include <cstddef>

// Of Zoltan, in programs that link it.
extern "C" {
[[gnu::weak]] void Zoltan_Memory_Debug(int level);
[[gnu::weak]] std::size_t Zoltan_Memory_Usage(int kind);
}

namespace rrcb::test {

/// Memory in use on this rank. MPI's is left out: it depends on how many messages came early.
struct HeldMemory {
    long blocks = memory_layer::live_blocks();
    long bytes = memory_layer::live_bytes();  ///< of the blocks
    std::size_t bytes_of_zoltan = Zoltan_Memory_Usage == nullptr ? 0 : Zoltan_Memory_Usage(0);
};

/// Zoltan counts its bytes at this level only, so it is set before main().
inline const bool zoltan_counts = [] {
    if (Zoltan_Memory_Debug != nullptr) Zoltan_Memory_Debug(2);
    return Zoltan_Memory_Debug != nullptr;
}();

/// Fails the test if `num_calls` calls since `before` left a block behind, made the blocks grow by
/// 8 bytes each, or left memory of Zoltan.
inline void expect_no_growth(const HeldMemory& before, int num_calls) {
    const HeldMemory after;
    EXPECT_EQ(after.blocks, before.blocks);
    EXPECT_LT(after.bytes - before.bytes, 8L * num_calls);
    EXPECT_EQ(after.bytes_of_zoltan, before.bytes_of_zoltan);
}

}  // namespace rrcb::test
