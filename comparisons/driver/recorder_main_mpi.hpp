#pragma once

#include <mpi.h>

#include <functional>
#include <string>

namespace comparisons {

/// main() of a command `NAME DIRECTORY [--quick]` that records on all ranks: starts MPI and Zoltan,
/// and ends them. What `record` throws on any rank is printed and ends the run.
int run_recorder(
    int argc, char** argv, const std::string& name,
    const std::function<void(const std::string& directory, bool quick, MPI_Comm comm)>& record);

}  // namespace comparisons
