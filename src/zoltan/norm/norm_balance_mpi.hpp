#pragma once

#include "collective/participant.hpp"
#include "zoltan/norm/multicriteria.hpp"

#include <rrcb/balance.hpp>

namespace rrcb::zoltan {

/// Divides the objects by cuts with equal norms of the loads on both sides. Of the axes whose norm
/// is within the tolerance of the smallest, a cut crosses the longest.
///
/// `result` is the balancer's for the sum of the weights of the same points, which is not 0. Its
/// cuts, parts and measures are replaced. Collective over `self.comm`: per level of the tree a few
/// rounds of two reductions, for all cuts of the level together. No object moves. Same bits on
/// every rank, whatever the order of MPI's sums. Throws Error on all ranks alike.
void balance_norm(const Points& points, const Criteria& criteria, const Options& options,
                  Balance& result, Participant& self);

}  // namespace rrcb::zoltan
