#pragma once

#include "workload_mpi.hpp"

#include <mpi.h>

#include <string>

namespace comparisons {

/// The points of a dumped call, and what to tell of it.
struct Replay {
    Workload workload;
    std::string note;  ///< lines, on every rank
};

/// Reads a dump of the plug-in's, every rank its share. Collective over `comm`.
///
/// Points lie on the ranks they came from if there are as many; otherwise they are dealt out in
/// their order, the same number to each. Throws Failure on every rank for a dump that is not whole.
Replay read_replay(const std::string& folder, MPI_Comm comm);

}  // namespace comparisons
