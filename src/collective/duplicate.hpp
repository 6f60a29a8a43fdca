#pragma once

#include <mpi.h>

namespace rrcb::mpi {

/// Returns the duplicate kept with `user`, only for the library's messages; errors on it return.
/// Freed with `user`.
///
/// Collective over `user` in the first call with it: one more reduction, so that all ranks throw
/// the same Error if one of them fails; then nothing is kept. Throws Error on every rank, without a
/// message, for MPI_COMM_NULL and intercommunicators.
MPI_Comm duplicate_of(MPI_Comm user);

/// Returns the duplicate kept with `user`, or null. Not collective.
const MPI_Comm* find_duplicate(MPI_Comm user);

}  // namespace rrcb::mpi
