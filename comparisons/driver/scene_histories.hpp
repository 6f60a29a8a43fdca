#pragma once

#include "load_history.hpp"

#include <string>
#include <vector>

namespace comparisons {

/// Settings by which a scene's history is recorded.
struct Recording {
    std::string scene;
    bool quick = false;  ///< the coarse scene
    int num_parts = 8;
    int num_times = 41;  ///< from the start of the scene to its end
    int most_steps = 4000;
};

/// Points in each part, where the parts are made at some time of a simulation and stay.
///
/// Simulates the scene and keeps its points at `num_times` times; each time they are divided by
/// rrcb::balance, and those of the later times counted in its parts. Between the times loads are
/// interpolated: those of equally old parts, each over the steps. In units of the mean load; a
/// rebalance costs each of `costs`: a history for each. Steps beyond `most_steps` are taken
/// together. Not collective: a rank does the whole alone. Throws Failure, rrcb::Error and what the
/// simulation throws.
std::vector<LoadHistory> scene_histories(const Recording& recording,
                                         const std::vector<double>& costs);

}  // namespace comparisons
