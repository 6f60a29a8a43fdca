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

/// What one method did with one workload; the same on every rank but for the parts.
struct Measurement {
    std::string method;
    std::string error;                   ///< empty unless the method failed
    std::vector<double> times_ms;        ///< per repeat, of the slowest rank
    std::vector<double> imbalances;      ///< per seed; a single one of methods that draw no points
    double worst_unbalance_percent = 0;  ///< Lu of largest size; of the seed in the middle by it
    double moved_fraction = 0;           ///< median over the seeds
    Traffic traffic;                     ///< of one call: messages and bytes of all ranks, the most
                                         ///< collectives and communicators of any rank
    std::optional<int> rounds;  ///< of counting in a call of our own methods, by the interface: 1
                                ///< where the estimate was accepted, 0 where none was refined
    std::map<std::string, CallCount> calls;  ///< the same call by MPI function, over all ranks
    Ghosts ghosts;                           ///< of these parts; 0 of a method that failed
    std::vector<rrcb::Part> parts;  ///< of this rank's points, as the counted call made them
};

/// Seeds that a method is judged over when its points are pseudo-random.
inline constexpr int num_judged_seeds = 10;

/// Runs every method on the workload, interleaved repeat by repeat. Collective over `comm`.
///
/// The first call of each method is left out of the times; quality and traffic are of last calls
/// of their own, so that counting disturbs no time. Methods that vary with the seed take
/// num_judged_seeds of them: the timed calls in turn, quality over all, traffic and parts of the
/// first. A method that fails is left out from there on.
std::vector<Measurement> measure(const Workload& workload, std::span<const Method> methods,
                                 const MeasurementPlan& plan, Progress& progress, MPI_Comm comm);

/// The entry of largest absolute value, with its sign; of two the negative one. 0 of none.
double largest_by_size(std::span<const double> values);

}  // namespace comparisons
