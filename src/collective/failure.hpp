#pragma once

#include <rrcb/error.hpp>

#include <array>
#include <exception>
#include <new>
#include <string_view>

namespace rrcb {

/// Number in place of a failing rank's where none has failed.
inline constexpr int no_rank = -1;

/// Number in place of a failing rank's where the message could not say which has failed.
inline constexpr int some_rank = -2;

/// Error held back until the ranks have agreed on it. Holding it takes no memory.
struct Failure {
    bool failed = false;
    ErrorCode code = ErrorCode::internal;
    std::array<char, 512> text{};  ///< cut short where it is longer; ends with a 0
    bool may_follow = false;       ///< from the failure of another rank, see compare()
};

inline Failure failure_of(ErrorCode code, std::string_view text) {
    Failure failure{true, code};
    text.copy(failure.text.data(), failure.text.size() - 1);
    return failure;
}

/// Runs one local step; returns what it throws.
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
