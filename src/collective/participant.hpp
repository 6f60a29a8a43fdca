#pragma once

#include <rrcb/error.hpp>

#include <mpi.h>

#include <array>
#include <exception>
#include <new>
#include <string_view>
#include <utility>

namespace rrcb {

/// An error held back until the ranks have agreed on it; it takes no memory to hold it.
struct Failure {
    bool failed = false;
    ErrorCode code = ErrorCode::internal;
    std::array<char, 512> text{};  ///< cut short where it is longer; ends with a 0
};

inline Failure failure_of(ErrorCode code, std::string_view text) {
    Failure failure{true, code};
    text.copy(failure.text.data(), failure.text.size() - 1);
    return failure;
}

/// Runs one local step; what it throws is held back so that the rank can go on to the agreement.
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

/// One rank in a collective call: it takes part to the end, whatever goes wrong on it.
struct Participant {
    MPI_Comm comm;
    Failure failure{};  ///< the first one here; held back until all have been told

    /// Runs a step that touches only what is here, unless an earlier one failed.
    template <class Step>
    void attempt(Step&& step) {
        if (!failure.failed) failure = rrcb::attempt(step);
    }

    /// Runs a step that other ranks wait for.
    template <class Step>
    void always(Step&& step) {
        Failure here = rrcb::attempt(step);
        if (here.failed && !failure.failed) failure = std::move(here);
    }
};

}  // namespace rrcb
