#pragma once

#include "collective/failure.hpp"

#include <mpi.h>

#include <utility>

namespace rrcb {

/// One rank in a collective call: it takes part to the end, whatever goes wrong on it.
struct Member {
    MPI_Comm comm;
    Failure failure{};  ///< the first one here; held back until all have been told

    /// Runs a step that touches only what is here, unless an earlier one failed.
    template <class Step>
    void locally(Step&& step) {
        if (!failure.failed) failure = attempt(step);
    }

    /// Runs a step that other ranks wait for.
    template <class Step>
    void always(Step&& step) {
        Failure here = attempt(step);
        if (here.failed && !failure.failed) failure = std::move(here);
    }
};

}  // namespace rrcb
