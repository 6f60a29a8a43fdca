#pragma once

#include "zoltan/call/objects.hpp"
#include "zoltan/norm/multicriteria.hpp"

#include <mpi.h>

namespace rrcb::zoltan {

/// Gives objects of several weights a single one, to estimate cuts by: the sum of theirs. Each
/// weight is divided by its total over all objects unless OBJ_WEIGHTS_COMPARABLE is set.
///
/// Collective over `comm` where OBJ_WEIGHT_DIM is above 1, one reduction; otherwise nothing.
void combine_weights(const Parameters& parameters, Workspace& workspace, MPI_Comm comm,
                     Objects& objects);

}  // namespace rrcb::zoltan
