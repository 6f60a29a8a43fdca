#pragma once

#include "method.hpp"
#include "progress.hpp"
#include "traffic.hpp"
#include "workload.hpp"

#include <mpi.h>

#include <map>
#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// What one method did with one workload; the same on every rank but for the parts.
struct Measurement {
    std::string method;
    std::string error;             ///< empty unless the method failed
    std::vector<double> times_ms;  ///< per repeat, of the slowest rank
    double imbalance = 0;
    double worst_unbalance_percent = 0;
    double moved_fraction = 0;
    Traffic traffic;  ///< of one call: messages and bytes of all ranks, the most
                      ///< collectives and communicators of any rank
    std::map<std::string, CallCount> calls;  ///< the same call by MPI function, over all ranks
    std::vector<rrcb::Part> parts;           ///< of this rank's points
};

/// How to measure.
struct MeasurementPlan {
    Lists lists = Lists::parts;
    int repeats = 7;
};

/// Runs every method on the workload, interleaved repeat by repeat. Collective over `comm`.
///
/// The first call of each method is left out of the times; quality and traffic are of a last call
/// of its own, so that counting disturbs no time. A method that fails is left out from there on.
std::vector<Measurement> measure(const Workload& workload, std::span<const Method> methods,
                                 const MeasurementPlan& plan, Progress& progress, MPI_Comm comm);

/// Middle of the values, the mean of the two middle ones when their number is even; 0 of none.
double median(std::vector<double> values);

}  // namespace comparisons
