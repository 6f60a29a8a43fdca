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

/// Whether a list in C has these entries.
bool equal(const auto* from, std::size_t count, const auto& list) {
    return std::equal(from, from + count, list.begin(), list.end());
}

}  // namespace rrcb::test
