#pragma once

#include "arguments.hpp"
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
    /// For each seed; a single value if the method draws no points.
    std::vector<double> imbalances;
    /// Lu of the largest absolute value, for the seed with the median of this value.
    double worst_unbalance_percent = 0;
    double moved_fraction = 0;  ///< median over the seeds
    /// Traffic of one call. Messages and bytes are sums over all ranks; collectives and
    /// communicators are those of the rank with most of them.
    Traffic traffic;
    /// Rounds of counting in a call of the library's own methods, from the report: 1 if the
    /// estimate was accepted, 0 if cuts are not refined.
    std::optional<int> rounds;
    std::map<std::string, CallCount> calls;  ///< that traffic by MPI function, over all ranks
    Ghosts ghosts;                           ///< of these parts; 0 if the method failed
    std::vector<rrcb::Part> parts;           ///< of this rank's points, in the counted call
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
                                 const MeasurementPlan& plan, MPI_Comm comm);

/// Returns the entry of largest absolute value, with its sign. Of two such entries it returns the
/// negative one. Returns 0 if there are no entries.
double largest_by_size(std::span<const double> values);

}  // namespace comparisons
