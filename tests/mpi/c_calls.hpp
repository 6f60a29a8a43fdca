#pragma once

#include "../support/common.hpp"
#include "../support/ranks.hpp"

#include <rrcb/rrcb.h>
#include <rrcb/rrcb.hpp>

namespace rrcb::test {

/// Expects that a call was refused on all ranks with the same text, which contains `text`.
/// Collective.
inline void expect_refused(int code, const std::string& text) {
    EXPECT_EQ(code, RRCB_INVALID_ARGUMENT);
    std::array<char, 512> first{};
    std::strncpy(first.data(), rrcb_last_error(), first.size() - 1);
    MPI_Bcast(first.data(), static_cast<int>(first.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
    EXPECT_STREQ(rrcb_last_error(), first.data());
    EXPECT_NE(std::string(rrcb_last_error()).find(text), std::string::npos) << rrcb_last_error();
}

/// Returns a tree of cuts in C.
inline rrcb_cuts cuts_of(int dimension, int num_parts, const rrcb_cut* tree, int group_size = 1,
                         int larger_below = 0, int round_robin_block = 0,
                         const std::int32_t* numbers = nullptr, double debt = 0) {
    return {sizeof(rrcb_cuts), dimension,         num_parts, tree, group_size,
            larger_below,      round_robin_block, numbers,   debt};
}

/// Whether a list in C has these entries.
bool equal(const auto* from, std::size_t count, const auto& list) {
    return std::equal(from, from + count, list.begin(), list.end());
}

}  // namespace rrcb::test
