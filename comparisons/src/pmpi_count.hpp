#pragma once

#include <mpi.h>

#include <cstdint>

namespace comparisons {

bool counting_traffic();

/// A message of `count` items from this rank to `destination`.
void count_message(const char* function, int count, MPI_Datatype type, int destination,
                   MPI_Comm comm);

/// This rank's part in a collective, in bytes.
void count_collective(const char* function, std::int64_t bytes_in, std::int64_t bytes_out);

/// A collective that makes a communicator.
void count_communicator(const char* function);

/// Bytes of `count` items.
std::int64_t bytes_of(std::int64_t count, MPI_Datatype type);

/// Adds the processor time of its scope to the time in MPI, while traffic is counted.
class InMpi {
  public:
    InMpi();
    ~InMpi();
    InMpi(const InMpi&) = delete;
    InMpi& operator=(const InMpi&) = delete;

  private:
    double start_ = 0;
};

}  // namespace comparisons
