#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

namespace rrcb::mpi {

/// Belongings that the library keeps with a caller's communicator; freed with it.
struct Duplicate {
    MPI_Comm comm = MPI_COMM_NULL;       ///< for the library's messages alone; errors on it return
    std::vector<std::int64_t> per_rank;  ///< see per_rank_of()
};

/// Ranks up to which numbers for all of them are kept from the first call on; tests lower it.
inline int most_ranks_at_once = 4096;

/// Duplicate kept with `user`.
///
/// Collective over `user` when called for the first time with it: one more reduction, so that all
/// ranks throw the same Error when one of them fails; then nothing is kept. Throws Error on every
/// rank, without a message, for MPI_COMM_NULL and intercommunicators.
Duplicate& duplicate_with(MPI_Comm user);

/// A number for each rank, to send when memory is short.
///
/// Beyond most_ranks_at_once collective when called for the first time: one reduction, so that all
/// ranks throw the same Error when one has no memory.
std::span<std::int64_t> per_rank_of(Duplicate& kept);

inline MPI_Comm duplicate_of(MPI_Comm user) {
    return duplicate_with(user).comm;
}

}  // namespace rrcb::mpi
