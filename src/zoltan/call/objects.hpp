#pragma once

#include "zoltan/call/ids.hpp"
#include "zoltan/handle/parameters.hpp"
#include "zoltan/real/buffer.hpp"

#include <rrcb/points.hpp>

#include <zoltan.h>

namespace rrcb::zoltan {

/// Memory that one handle's calls share.
struct Workspace {
    Scratch<double> coordinates;
    Scratch<double> weights;
    Scratch<float> callback_weights;
    Scratch<double> reduced;  ///< coordinates in the frame of a flat geometry
};

/// One rank's objects, as its callbacks describe them.
struct Objects {
    int count = 0;
    bool warned = false;       ///< a callback returned ZOLTAN_WARN
    bool names_parts = false;  ///< a callback tells the part of each object
    ZoltanArray<IdWord> global_ids;
    ZoltanArray<IdWord> local_ids;   ///< null when ids have no local part
    ZoltanArray<int> initial_parts;  ///< null when no callback tells them
    ZoltanArray<int> new_ranks;      ///< room for where each object goes, while a failure
    ZoltanArray<int> new_parts;      ///< can still be agreed on; null when not asked for
    Points points;                   ///< borrowed from the workspace
};

/// Asks the registered callbacks. Not collective. Throws Failure for a missing or failing callback,
/// a negative count, or a dimension that is not 1, 2 or 3.
Objects collect_objects(Zoltan_Struct* zz, const Parameters& parameters, Workspace& workspace);

}  // namespace rrcb::zoltan
