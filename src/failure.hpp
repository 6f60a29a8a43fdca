#pragma once

#include <rrcb/error.hpp>

#include <exception>
#include <new>
#include <string>

namespace rrcb {

/// An error held back until the ranks have agreed on it.
struct Failure {
    bool failed = false;
    ErrorCode code = ErrorCode::internal;
    std::string text;
};

/// Runs one local step; what it throws is held back so that the rank can go on to the agreement.
template <class Step>
Failure attempt(Step&& step) {
    try {
        step();
        return {};
    } catch (const Error& error) {
        return {true, error.code(), error.what()};
    } catch (const std::bad_alloc&) {
        return {true, ErrorCode::out_of_memory, "out of memory"};
    } catch (const std::exception& error) {
        return {true, ErrorCode::internal, error.what()};
    } catch (...) {
        return {true, ErrorCode::internal, "unknown exception"};
    }
}

}  // namespace rrcb
