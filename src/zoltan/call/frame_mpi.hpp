#pragma once

#include "collective/participant.hpp"
#include "zoltan/handle/frame.hpp"
#include "zoltan/handle/parameters.hpp"
#include "zoltan/handle/workspace.hpp"

namespace rrcb::zoltan {

/// Frame for the points of all ranks.
///
/// It has their principal axes where the extent along one is below the longest divided by `ratio`
/// (> 1), as in Zoltan. Weights do not count. `previous` (null on all ranks or on none) is kept
/// while the points are as flat in it. Points that the balancer refuses are not turned. Collective;
/// same bits on every rank. Throws Error on all ranks alike where one of them has failed.
Frame choose_frame(const Points& points, double ratio, const Frame* previous, Participant& self);

/// Positions that are cut: in their principal axes where REDUCE_DIMENSIONS finds the objects flat.
struct Flattened {
    Frame frame;
    Points points;  ///< borrowed
};

/// Positions for the cuts, in `room` where they are turned. Collective where REDUCE_DIMENSIONS is
/// set; `self` holds errors back.
Flattened flatten(const Points& points, const Parameters& parameters, const Frame* previous,
                  Scratch<double>& room, Participant& self);

}  // namespace rrcb::zoltan
