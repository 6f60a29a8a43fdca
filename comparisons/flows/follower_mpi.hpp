#pragma once

#include "workload_mpi.hpp"

#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace comparisons {

/// A way to call the balancer repeatedly while particles move.
struct Policy {
    std::string name;
    bool has_previous;  ///< passes the previous cuts; otherwise deals the particles anew
    bool keeps_axes;    ///< keeps the axes of the first call's cuts
    bool renumbers;     ///< calls rrcb::remap, so that many points keep their part
};

/// Returns all policies, or those with the given names in the same order. Not collective. Throws
/// Failure for an unknown name.
std::vector<Policy> policies(const std::vector<std::string>& names = {});

/// Counts of one call, summed over all ranks.
struct CallCounts {
    std::int64_t moved = 0;     ///< particles whose part is not that of the previous call
    std::int64_t messages = 0;  ///< counted as in Traffic
};

/// Balances the particles of a flow by a policy.
///
/// Each rank holds the particles of its parts. In the first call, and in each call without previous
/// cuts, particle i is instead on rank i modulo the number of ranks.
class Follower {
  public:
    Follower(const Policy& policy, int num_parts, MPI_Comm comm);

    /// Balances all particles. They have the same order in each call. Collective.
    CallCounts go_on(const Workload& all);

    /// Returns the part of each particle in the last call, on every rank.
    const std::vector<rrcb::Part>& parts() const { return parts_; }

  private:
    std::vector<std::size_t> particles_here(std::size_t count) const;
    void renumber(std::vector<rrcb::Part>& parts, const std::vector<std::size_t>& here) const;

    Policy policy_;
    rrcb::Options options_{};
    MPI_Comm comm_;
    std::vector<rrcb::RankRange> ranks_of_parts_{};
    rrcb::Cuts cuts_{};
    std::vector<rrcb::Part> parts_{};
};

}  // namespace comparisons
