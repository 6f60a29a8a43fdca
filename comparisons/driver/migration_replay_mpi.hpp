#pragma once

#include "part_loads_mpi.hpp"

#include <mpi.h>
#include <mpm/decomposition.hpp>

#include <cstdint>

namespace comparisons {

/// What points do between two calls of a balancer.
enum class Between {
    follow,  ///< one that has left the box of its rank goes to the rank whose box holds it
    stay     ///< they wait for the call on their ranks
};

/// Points that change rank under one balancer, over all its calls but the first.
struct Migration {
    int calls = 0;
    std::int64_t points = 0;
    std::int64_t crossed = 0;    ///< that were outside the box of their rank before a call
    std::int64_t moved = 0;      ///< by the calls
    double mean_imbalance = 1;   ///< behind the calls
    double worst_imbalance = 1;  ///< of the same
};

/// Lets points move as recorded, and calls `balancer` at each time. Collective over `comm`.
///
/// Where points follow their boxes, as in the mini app, `crossed` have gone before the call; where
/// they stay, `moved` has those of them that the call sends on. The first call finds the points as
/// the tracks have them. Throws what the balancer throws.
Migration replay_migration(const PointTracks& tracks, const mpm::Balancer& balancer,
                           Between between, MPI_Comm comm);

}  // namespace comparisons
