#pragma once

#include "interval_map.hpp"
#include "method.hpp"
#include "moving_points_mpi.hpp"

#include <mpi.h>

#include <span>
#include <string>

namespace comparisons {

/// Settings by which the histories of a scene are recorded.
struct IntervalRecording {
    std::string scene;
    int num_times = 101;  ///< at which parts are made and loads counted, from the start to the end
    int num_windows = 5;  ///< of the CallTurns
    int num_turns = 6;
    double seconds_per_point = 0;  ///< where steps do no work; 0: what they take
};

/// A recorded scene.
struct RecordedScene {
    MappedScene map;
    double seconds_per_point = 0;  ///< processor time outside MPI of a step, for each point
};

/// Moves the points to their end and records the history of each method; one part per rank.
///
/// The load of a rank is its points, by PointTracks; what a rebalance costs is that of the
/// CallTurns. Collective over `comm`. Throws what the balancers and the points throw.
RecordedScene record_intervals(MovingPoints& points, std::span<const Method> methods,
                               const IntervalRecording& recording, MPI_Comm comm);

}  // namespace comparisons
