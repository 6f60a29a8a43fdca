#pragma once

#include "../support/common.hpp"

#include <stdexcept>

namespace mpm::test {

/// Expects all of the words in a message.
inline void expect_names(const std::string& error, const std::vector<std::string>& words) {
    for (const std::string& word : words)
        EXPECT_NE(error.find(word), std::string::npos) << word << " is not in: " << error;
}

/// Expects that a call throws std::invalid_argument with all of the words.
template <class Call>
void expect_refused(Call&& call, const std::vector<std::string>& words) {
    try {
        call();
        ADD_FAILURE() << words.front();
    } catch (const std::invalid_argument& error) {
        expect_names(error.what(), words);
    }
}

}  // namespace mpm::test
