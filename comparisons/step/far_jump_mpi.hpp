#pragma once

#include "flow_mpi.hpp"

#include <cstddef>
#include <vector>

namespace comparisons {

/// What a rank observes after a point has jumped beyond all neighbours of its rank.
struct Discovery {
    int calls = 0;           ///< calls that send messages, from the jump to the call that failed
    std::size_t points = 0;  ///< number of this rank's points at that time
    bool is_known = false;   ///< whether a call has failed
};

/// Moves a point of rank 0 to the opposite corner of the box. Then all ranks run the steps of the
/// arm "neighbours" until a call fails. Collective.
/// @return the observation of each rank, on every rank, after at most 100 steps
std::vector<Discovery> jump_far(const Flow& flow);

}  // namespace comparisons
