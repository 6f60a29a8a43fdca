#pragma once

#include "traffic.hpp"

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace comparisons {

/// The network for which the time of counted traffic is estimated.
struct Network {
    double latency_s = 1.5e-6;  ///< of a message; a collective of n ranks takes log2(n) times as
                                ///< long
    double bytes_per_second = 12e9;
};

/// The phase in which the ranks wait for the collectives of a phase.
enum class Waits { in_the_phase, in_the_next };

/// Returns the seconds that the network needs for one rank's traffic among `num_ranks` ranks. A
/// collective that overlaps with the work until the next phase takes one latency. Not collective.
double network_seconds(const Traffic& traffic, int num_ranks, const Network& network,
                       Waits waits = Waits::in_the_phase);

/// Returns the largest value of any rank in each phase. Collective over `comm`.
std::vector<double> largest_of_ranks(std::vector<double> of_phases, MPI_Comm comm);

/// The cost of a sequence of phases. All ranks start each phase together.
struct PathCost {
    double work_s = 0;  ///< processor time outside MPI, summed over the ranks
    /// Processor time of the slowest rank of each phase, summed over the phases.
    double path_s = 0;
    double root_s = 0;     ///< processor time of rank 0, for which the others may wait
    double network_s = 0;  ///< network_seconds() of the busiest rank of each phase, summed over the
                           ///< phases
    std::int64_t messages = 0, bytes = 0;  ///< of all ranks and phases, as Traffic counts them
};

/// Records the work and traffic of this rank in a sequence of phases.
///
/// Work is the processor time outside MPI. This is the time that a rank needs on a core of its own,
/// even if several ranks share a core in this run.
class PhaseLog {
  public:
    explicit PhaseLog(Waits waits = Waits::in_the_phase) : waits_(waits) {}

    /// Runs `action` as the next phase.
    template <typename Action>
    void record(Action&& action) {
        const Recording recording(*this);
        action();
    }

    /// Returns the work and network time of the last phase if there are `num_ranks` ranks, in s.
    double last_s(int num_ranks) const;

    /// Returns the processor time outside MPI of this rank in each phase, in s.
    const std::vector<double>& work_s() const { return work_s_; }

    /// Returns the cost. Collective over `comm`, all ranks of which have recorded the same phases.
    PathCost cost(MPI_Comm comm) const;

  private:
    /// Ends the phase in its destructor, so also if the action throws.
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
