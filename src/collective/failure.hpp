#pragma once

#include <rrcb/error.hpp>

#include <array>
#include <exception>
#include <new>
#include <string_view>

namespace rrcb {

/// The failing rank if none has failed.
inline constexpr int no_rank = -1;

/// The failing rank if a message could not name it.
inline constexpr int some_rank = -2;

/// Error held back until the ranks have agreed on it. Does not allocate.
struct Failure {
    bool failed = false;
    ErrorCode code = ErrorCode::internal;
    std::array<char, 512> text{};  ///< cut short if it is longer; ends with a 0
    bool may_follow = false;       ///< another rank's failure may have caused it, see compare()
};

inline Failure failure_of(ErrorCode code, std::string_view text) {
    Failure failure{true, code};
    text.copy(failure.text.data(), failure.text.size() - 1);
    return failure;
}

/// Runs one local step; returns the exception that it throws.
template <class Step>
Failure attempt(Step&& step) {
    try {
        step();
        return {};
    } catch (const Error& error) {
        return failure_of(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return failure_of(ErrorCode::out_of_memory, "out of memory");
    } catch (const std::exception& error) {
        return failure_of(ErrorCode::internal, error.what());
    } catch (...) {
        return failure_of(ErrorCode::internal, "unknown exception");
    }
}

}  // namespace rrcb
