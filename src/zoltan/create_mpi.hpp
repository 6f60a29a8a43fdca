#pragma once

#include <mpi.h>
#include <zoltan.h>

namespace rrcb::zoltan {

/// Enters a new handle into the side table, on all ranks or on none.
///
/// Collective over `user`: one duplication, one reduction. Throws Error on all ranks alike.
void create_state(const Zoltan_Struct* zz, MPI_Comm user);

}  // namespace rrcb::zoltan
