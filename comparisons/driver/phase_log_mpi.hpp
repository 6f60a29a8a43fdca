#pragma once

#include "traffic.hpp"

#include <mpi.h>

#include <vector>

namespace comparisons {

/// The network that counted traffic is charged to.
struct Network {
    double latency_s = 1.5e-6;  ///< of a message; a collective of n ranks takes log2(n) of them
    double bytes_per_second = 12e9;
};

/// Place where the ranks wait for the collectives of a phase.
enum class Waits { in_the_phase, in_the_next };

/// Seconds the network needs for one rank's traffic among `num_ranks`. A collective that overlaps
/// with the work up to the next phase takes one latency. Not collective.
double network_seconds(const Traffic& traffic, int num_ranks, const Network& network,
                       Waits waits = Waits::in_the_phase);

/// What phases cost that all ranks start together.
struct PathCost {
    double work_s = 0;     ///< processor time outside MPI, of all ranks together
    double path_s = 0;     ///< that of the slowest rank of each phase
    double root_s = 0;     ///< that of rank 0, for which the others may wait
    double network_s = 0;  ///< traffic of the busiest rank of each phase, by network_seconds
};

/// Work and traffic of this rank in each of a row of phases.
///
/// Work is the processor time outside MPI: what a rank needs on a core of its own, however many
/// ranks share one here.
class PhaseLog {
  public:
    explicit PhaseLog(Waits waits = Waits::in_the_phase) : waits_(waits) {}

    /// Runs `action` as one more phase.
    template <typename Action>
    void record(Action&& action) {
        const Recording recording(*this);
        action();
    }

    /// Work and network of the latest phase, as one of `num_ranks`, in s.
    double last_s(int num_ranks) const;

    /// Collective over `comm`, whose ranks have recorded the same phases.
    PathCost cost(MPI_Comm comm) const;

  private:
    /// Ends its phase also when the action throws.
    class Recording {
      public:
        explicit Recording(PhaseLog& log);
        ~Recording();
        Recording(const Recording&) = delete;
        Recording& operator=(const Recording&) = delete;

      private:
        PhaseLog& log_;
        double start_ = 0;
    };

    Waits waits_;
    std::vector<double> work_s_;
    std::vector<Traffic> traffic_;
};

}  // namespace comparisons
