#pragma once

#include "method.hpp"
#include "partitioner.hpp"
#include "workload.hpp"

#include <mpi.h>

#include <memory>

namespace comparisons {

/// The partitioner that a method names. Collective over `comm`; the workload must outlive it.
///
/// Throws Failure when a parameter is refused.
std::unique_ptr<Partitioner> make_partitioner(const Method& method, const Workload& workload,
                                              Lists lists, MPI_Comm comm);

}  // namespace comparisons
