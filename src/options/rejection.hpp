#pragma once

#include <rrcb/error.hpp>

#include <new>
#include <string>

namespace rrcb {

[[noreturn]] inline void reject(const std::string& what) {
    throw Error(ErrorCode::invalid_argument, what);
}

inline void require(bool condition, const char* what) {
    if (!condition) reject(what);
}

/// Throws Error; its text is empty if there is no memory for it.
template <class MakeText>
[[noreturn]] void throw_error(ErrorCode code, MakeText&& make_text) {
    try {
        throw Error(code, make_text());
    } catch (const std::bad_alloc&) {
        throw Error(code);
    }
}

/// Runs a public function that is not collective, and converts std::bad_alloc to Error.
template <class Body>
auto locally(Body&& body) {
    try {
        return body();
    } catch (const std::bad_alloc&) {
        throw_error(ErrorCode::out_of_memory, [] { return "out of memory"; });
    }
}

}  // namespace rrcb
