#pragma once

#include "collective/participant.hpp"

#include <mpi.h>

#include <cstdint>

namespace rrcb::mpi {

/// Begins a collective call with a communicator of the caller's, on a duplicate that is only for
/// the library's messages; errors on it return. It is kept with `user`, and freed with it.
///
/// Collective over `user` in the first call with it: a reduction for the group, and one more, so
/// that all ranks throw the same Error if one of them fails; then nothing is kept. Throws Error on
/// every rank, without a message, for MPI_COMM_NULL, intercommunicators, and outside of MPI_Init
/// and MPI_Finalize. If ranks begin different calls, the meeting of the call throws Error.
Participant enter(MPI_Comm user, CallName call);

/// Returns false before MPI_Init and after MPI_Finalize.
bool is_running();

/// Throws Error unless MPI is running.
void check_is_running();

/// Returns the duplicate kept with `user`, or null. Not collective.
const MPI_Comm* find_duplicate(MPI_Comm user);

/// Throws Error if `group` is known, and not that of this communicator. Not collective.
void require_group(std::uint64_t group, const char* made, const Participant& self);

}  // namespace rrcb::mpi
