#pragma once

#include "flow_mpi.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace comparisons {

/// How a rank finds out that a point has passed all neighbours of its rank.
struct Discovery {
    int calls = 0;           ///< with messages, from the jump to the one that failed
    std::size_t points = 0;  ///< of this rank then
    std::string text{};      ///< of the error
};

/// Lets a point of rank 0 jump to the opposite corner of the box, and every rank make the steps of
/// the arm "neighbours" until a call fails. Collective.
/// @return of each rank, on every rank; a rank that finds nothing in 100 steps has no text
std::vector<Discovery> jump_far(const Flow& flow);

}  // namespace comparisons
