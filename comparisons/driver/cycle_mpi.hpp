#pragma once

#include "sweep_mpi.hpp"

#include <mpm/decomposition.hpp>

#include <vector>

namespace comparisons {

/// What one of several calls did to points that stand still.
struct StillCall {
    double imbalance = 1;
    double moved_fraction = 0;  ///< share of the points that changed rank
};

/// Calls `balancer` again and again on the points of `workload`, which stand still but go to the
/// rank of their part after every call. Collective over `comm`.
///
/// Weights are not used. Throws what the balancer throws.
std::vector<StillCall> balance_still_points(Workload workload, const mpm::Balancer& balancer,
                                            int num_calls, MPI_Comm comm);

/// The slope's points at the start, in slabs of equal width. Collective.
Workload start_of_slope(const Sweep& sweep);

/// That of the start_of_slope under every one of the cycle_settings: cycle.csv. True when none
/// failed. Collective.
bool study_cycle(const Sweep& sweep);

}  // namespace comparisons
