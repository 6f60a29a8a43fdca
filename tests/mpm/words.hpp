#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace mpm::test {

/// Expects all of the words in a message.
inline void expect_names(const std::string& error, const std::vector<std::string>& words) {
    for (const std::string& word : words)
        EXPECT_NE(error.find(word), std::string::npos) << word << " is not in: " << error;
}

}  // namespace mpm::test
