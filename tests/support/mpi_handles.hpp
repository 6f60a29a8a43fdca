#pragma once

namespace rrcb::test {

/// Handles of MPI that this rank made and did not free.
struct MpiHandles {
    int communicators = 0;
    int datatypes = 0;
    int operations = 0;
    int attribute_keys = 0;

    bool operator==(const MpiHandles&) const = default;
};

/// What the program holds, as a layer between it and MPI counts.
MpiHandles mpi_handles();

}  // namespace rrcb::test
