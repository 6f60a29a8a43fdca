#pragma once

#include "workload_mpi.hpp"

#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace comparisons {

/// A way to call the balancer along a flow.
struct Policy {
    std::string name;
    bool has_previous;  ///< gives the cuts of the call before; otherwise deals the particles anew
    bool keeps_axes;    ///< of the first call
    bool renumbers;     ///< parts, by rrcb::remap, so that many points keep theirs
};

/// Returns the policies, or those of some names in the order of these. Not collective. Throws
/// Failure for an unknown name.
std::vector<Policy> policies(const std::vector<std::string>& names = {});

/// Counts of a call over all ranks.
struct CallCounts {
    std::int64_t moved = 0;  ///< particles whose part is not that of the call before; first call: 0
    std::int64_t messages = 0;  ///< as of Traffic
};

/// A program that balances the particles of a flow by a policy.
///
/// Each rank holds the particles of its parts. At the first call, and at each one without earlier
/// cuts, particle i is on rank i modulo the number of ranks instead.
class Follower {
  public:
    Follower(const Policy& policy, int num_parts, MPI_Comm comm);

    /// Balances all particles, which have the same order at each call. Collective.
    CallCounts go_on(const Workload& all);

    /// Returns the part of each particle after the last call, on every rank.
    const std::vector<rrcb::Part>& parts() const { return parts_; }

  private:
    std::vector<std::size_t> particles_here(std::size_t count) const;
    void renumber(std::vector<rrcb::Part>& parts, const std::vector<std::size_t>& here) const;

    Policy policy_;
    rrcb::Options options_{};
    MPI_Comm comm_;
    int rank_ = 0;
    std::vector<rrcb::RankRange> ranks_of_parts_{};
    rrcb::Cuts cuts_{};
    std::vector<rrcb::Part> parts_{};
};

}  // namespace comparisons
