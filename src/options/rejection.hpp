#pragma once

#include <rrcb/error.hpp>

#include <string>

namespace rrcb {

[[noreturn]] inline void reject(const std::string& what) {
    throw Error(ErrorCode::invalid_argument, what);
}

inline void require(bool condition, const char* what) {
    if (!condition) reject(what);
}

}  // namespace rrcb
