#pragma once

#include "failure.hpp"
#include "parallel/communicator_mpi.hpp"

#include <mpi.h>

#include <exception>
#include <stdexcept>
#include <string>

namespace comparisons {

using mpm::rank_of;
using mpm::size_of;

/// Returns the message of the lowest rank whose message is not empty. All ranks get the same text;
/// it is empty if no rank has a message.
///
/// Collective over `comm`.
std::string first_message(const std::string& mine, MPI_Comm comm);

/// Throws Failure with first_message on every rank unless it is empty. Collective over `comm`.
void fail_together(const std::string& mine, MPI_Comm comm);

/// Runs a step that is not collective on rank 0. An exception in it becomes a Failure on every
/// rank.
template <typename Step>
void on_root(Step&& step, MPI_Comm comm) {
    const int rank = rank_of(comm);
    std::string message;
    if (rank == 0) {
        try {
            step();
        } catch (const std::exception& error) {
            message = error.what();
        }
    }
    fail_together(message, comm);
}

}  // namespace comparisons
