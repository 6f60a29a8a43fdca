#pragma once

#include "collective/failure.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/plan.hpp>
#include <rrcb/rrcb.h>

#include <mpi.h>

#include <optional>
#include <vector>

/// What a program in C holds by a pointer.
struct rrcb_balancer {
    MPI_Comm comm = MPI_COMM_NULL;
    rrcb::Options options{};
    rrcb::Cuts cuts{};
    std::optional<rrcb::Report> report{};
    std::optional<rrcb::Plan> plan{};
    std::vector<rrcb::Part> parts{};  ///< memory for the next call
};

namespace rrcb::c {

/// Keeps what the last function that failed on this thread has to say.
int code_of(const Failure& failure) noexcept;

/// Runs the body of a function; no exception leaves it.
template <class Body>
int guarded(Body&& body) noexcept {
    return code_of(attempt(body));
}

/// Throws the Error of a null pointer.
void require(const void* pointer, const char* name);

/// The same for the arrays of a call, of which points need all.
void require_arrays(std::size_t count, const void* coordinates, const void* parts);

/// Throws Error unless the balancer has cuts, or a plan.
void require_cuts(const rrcb_balancer& own);
void require_plan(const rrcb_balancer& own);

/// The same for functions of a balancer.
template <class Balancer, class Body>
int guarded(Balancer* balancer, Body&& body) noexcept {
    return guarded([&] {
        require(balancer, "balancer");
        body(*balancer);
    });
}

}  // namespace rrcb::c
