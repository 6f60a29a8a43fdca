#pragma once

#include "collective/participant.hpp"
#include "zoltan/norm/multicriteria.hpp"

#include <rrcb/balance.hpp>

namespace rrcb::zoltan {

/// Divides the objects so that the norms of the loads of the two sides of every cut are the same,
/// across the axis that gives the smallest norm, or, of those within the tolerance, the longest.
///
/// Collective over `self.comm`; same bits on every rank, whatever the order of MPI's sums. `result`
/// is what the balancer made of the same points and options for the sum of the weights, with weight
/// in it: its cuts, parts and measures are replaced. Per level of the tree: a few rounds of two
/// reductions for all cuts of the level together; no object moves. Throws Error on all ranks alike.
void balance_norm(const Points& points, const Criteria& criteria, const Options& options,
                  Balance& result, Participant& self);

}  // namespace rrcb::zoltan
