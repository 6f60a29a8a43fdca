#pragma once

#include "collective/participant.hpp"

#include <mpi.h>

#include <cstdint>

namespace rrcb::mpi {

/// Begins a collective call with a communicator of the caller. Messages are sent on a duplicate
/// that only the library uses, and on which MPI returns errors. It is kept with `user` and freed
/// together with it.
///
/// The first call with `user` is collective: one reduction finds the group, and another one lets
/// all ranks throw the same Error if one of them fails; nothing is kept then. Later calls send no
/// messages. Without a message, throws Error on every rank for MPI_COMM_NULL, for
/// intercommunicators, before MPI_Init and after MPI_Finalize. If ranks begin different calls, the
/// meeting of the call throws Error.
Participant enter(MPI_Comm user, CallName call);

/// Returns false before MPI_Init and after MPI_Finalize.
bool is_running();

/// Throws Error unless MPI is running.
void check_is_running();

/// Returns the duplicate kept with `user`, or null. Not collective.
const MPI_Comm* find_duplicate(MPI_Comm user);

/// Throws Error if `group` is known and differs from the group of this communicator. Not
/// collective.
void require_group(std::uint64_t group, const char* made, const Participant& self);

}  // namespace rrcb::mpi
