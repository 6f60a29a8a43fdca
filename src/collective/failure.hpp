#pragma once

#include <rrcb/error.hpp>

#include <array>
#include <exception>
#include <new>
#include <string_view>

namespace rrcb {

/// Stands for the failing rank if no rank has failed.
inline constexpr int no_rank = -1;

/// Stands for the failing rank if a message could not name it.
inline constexpr int some_rank = -2;

/// An Error that is held back until the ranks have agreed on it. It does not allocate.
struct Failure {
    bool failed = false;
    ErrorCode code = ErrorCode::internal;
    std::array<char, 512> text{};  ///< truncated if it is longer; ends with a 0
    bool may_follow = false;       ///< whether the failure of another rank may have caused it; see
                                   ///< compare()
};

inline Failure failure_of(ErrorCode code, std::string_view text) {
    Failure failure{true, code};
    text.copy(failure.text.data(), failure.text.size() - 1);
    return failure;
}

/// Runs one local step. Returns the exception that it throws as a Failure.
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
