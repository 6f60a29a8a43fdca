#pragma once

#include "collective/butterfly_mpi.hpp"
#include "cuts/path_search.hpp"

namespace rrcb {

/// What a rank needs to take part in a search of paths.
struct PathSearchRoom {
    PathSearchRoom(const Cuts& known, const Points& points, std::span<Part> parts, MPI_Comm comm);

    PathSearch search;
    Butterfly shared;
    Butterfly asked;
    ButterflyMessages messages;
};

/// Finds the parts of points where the cuts that a rank knows do not tell them; gives these cuts
/// and those that were needed.
///
/// Collective: a pass through the ranks where none asks. Otherwise one to share cuts, two for each
/// time that some rank asks, and one to end. All ranks have made their room and agreed on that.
Cuts search_together(PathSearchRoom& room, Participant& self);

}  // namespace rrcb
