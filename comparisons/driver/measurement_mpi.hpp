#pragma once

#include "arguments.hpp"
#include "progress.hpp"
#include "traffic.hpp"

#include <mpi.h>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comparisons {

/// The results of one method on one workload. All except the parts are the same on every rank.
struct Measurement {
    std::string method;
    std::string error;             ///< empty unless the method failed
    std::vector<double> times_ms;  ///< time on the slowest rank, for each repeat
    std::vector<double>
        imbalances;  ///< for each seed; a single value if the method draws no points
    double worst_unbalance_percent = 0;  ///< Lu of the largest absolute value, for the seed with
                                         ///< the median imbalance
    double moved_fraction = 0;  ///< median over the seeds
    Traffic traffic;            ///< of one call: messages and bytes of all ranks, the most
                                ///< collectives and communicators of any rank
    std::optional<int> rounds;  ///< of counting in a call of our own methods, by the interface: 1
                                ///< where the estimate was accepted, 0 where none was refined
    std::map<std::string, CallCount> calls;  ///< the same call by MPI function, over all ranks
    Ghosts ghosts;                           ///< of these parts; 0 of a method that failed
    std::vector<rrcb::Part> parts;  ///< of this rank's points, as the counted call made them
};

/// The number of seeds with which a method that uses pseudo-random points is judged.
inline constexpr int num_judged_seeds = 10;

/// Measures every method on the workload. The repeats of the methods are interleaved. Collective
/// over `comm`.
///
/// The first call of each method is not timed. Quality and traffic are measured in separate calls
/// at the end, so that counting does not affect the times. A method that varies with the seed is
/// run with num_judged_seeds seeds. The timed calls use them in turn; the quality is that of all
/// seeds, traffic and parts are those of the first. A method that fails is not called again.
std::vector<Measurement> measure(const Workload& workload, std::span<const Method> methods,
                                 const MeasurementPlan& plan, Progress& progress, MPI_Comm comm);

/// Returns the entry of largest absolute value, with its sign. Of two such entries it returns the
/// negative one. Returns 0 if there are no entries.
double largest_by_size(std::span<const double> values);

}  // namespace comparisons
