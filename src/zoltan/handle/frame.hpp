#pragma once

#include "zoltan/handle/workspace.hpp"

#include <rrcb/points.hpp>

#include <array>
#include <cstdint>

namespace rrcb::zoltan {

/// The principal axes that cuts of a flat geometry cross (REDUCE_DIMENSIONS).
///
/// Positions are turned to these axes, the longest first, and their thin directions dropped.
/// Without axes positions stay as they are.
struct Frame {
    std::int32_t dimension = 0;  ///< of the positions that come in
    std::int32_t num_axes = 0;   ///< of those that come out; 0: nothing is turned
    /// Coordinate axis that each axis of the frame is; -1 where it is none.
    std::array<std::int32_t, max_dimension> picked{-1, -1, -1};
    Vector origin{};  ///< subtracted first: a far-off cloud keeps its digits
    std::array<Vector, max_dimension> axes{};  ///< unit vectors; the thin ones come last

    bool operator==(const Frame&) const = default;

    bool turns() const { return num_axes > 0; }
};

/// Coordinate of a position along an axis of the frame, a thin one as well.
double coordinate_along(const Frame& frame, int axis, const double* position);

/// A position in the frame; only where the frame turns.
Vector place(const Frame& frame, const double* position);

/// Smallest box in the frame around a box. It holds the place of every position in the box, to the
/// last bit.
Box place(const Frame& frame, const Box& box);

/// Region of the frame in the form of Zoltan_RCB_Box: along the frame's axes, but from the origin
/// of the coordinates.
Box unshifted(const Frame& frame, const Box& region);

/// The points in the frame, with their weights; their coordinates lie in `scratch`. Throws
/// std::bad_alloc.
Points place(const Frame& frame, const Points& points, Scratch<double>& scratch);

/// Whether look-ups can use a frame that comes from outside.
bool is_sound(const Frame& frame);

}  // namespace rrcb::zoltan
