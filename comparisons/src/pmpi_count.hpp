#pragma once

#include <mpi.h>

#include <cstdint>

namespace comparisons {

bool counting_traffic();

/// A message of `count` items from this rank to `destination`.
void count_message(int count, MPI_Datatype type, int destination, MPI_Comm comm);

/// This rank's part in a collective, in bytes.
void count_collective(std::int64_t bytes_in, std::int64_t bytes_out);

/// Bytes of `count` items.
std::int64_t bytes_of(std::int64_t count, MPI_Datatype type);

}  // namespace comparisons
