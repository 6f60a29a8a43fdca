#pragma once

#include "failure.hpp"
#include "parallel/communicator_mpi.hpp"

#include <mpi.h>

#include <functional>
#include <string>

namespace comparisons {

using mpm::rank_of;
using mpm::size_of;

/// Returns the message of the lowest rank whose message is not empty. All ranks get the same text;
/// it is empty if no rank has a message.
///
/// Collective over `comm`.
std::string first_message(const std::string& mine, MPI_Comm comm);

/// Runs a step that is not collective on rank 0. An exception in it becomes a Failure on every
/// rank.
void on_root(const std::function<void()>& step, MPI_Comm comm);

}  // namespace comparisons
