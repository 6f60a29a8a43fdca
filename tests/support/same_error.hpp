#pragma once

#include "common.hpp"

#include <rrcb/error.hpp>

namespace rrcb::test {

/// Expects that `call` throws the same Error with a code on every rank, with `expected` in its
/// text. Collective.
template <class Call>
void expect_same_error(Call&& call, const std::string& expected,
                       ErrorCode code = ErrorCode::invalid_argument) {
    std::array<char, 512> text{};
    try {
        call();
        ADD_FAILURE() << "expected: " << expected;
    } catch (const Error& error) {
        std::string(error.what()).copy(text.data(), text.size() - 1);
        EXPECT_EQ(error.code(), code);
        EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
    std::array<char, 512> of_root = text;
    MPI_Bcast(of_root.data(), 512, MPI_CHAR, 0, MPI_COMM_WORLD);
    EXPECT_STREQ(text.data(), of_root.data());
}

}  // namespace rrcb::test
