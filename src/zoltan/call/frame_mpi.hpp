#pragma once

#include "collective/participant.hpp"
#include "zoltan/handle/frame.hpp"

namespace rrcb::zoltan {

/// The frame for the points of all ranks: by their principal axes where the extent along one is
/// below the longest divided by `ratio` (> 1), as Zoltan decides it; weights do not count.
///
/// `previous` (null, or not, on all ranks alike) is kept while the points are as flat in it.
/// Collective; same bits on every rank. Points that the balancer refuses are not turned. Throws
/// Error on all ranks alike when one of them failed on its own.
Frame choose_frame(const Points& points, double ratio, const Frame* previous, Participant& self);

}  // namespace rrcb::zoltan
