#pragma once

#include <mpi.h>
#include <zoltan.h>

namespace rrcb::zoltan {

/// Enters a new handle into the side table, on all ranks or on none.
///
/// It is on none if Zoltan's functions come from several libraries on any rank. RRCB_REPLACE on one
/// rank holds on all.
///
/// Returns false if some ranks do not run the plug-in, which RollCall has reported. The real
/// Zoltan_Create must have returned: it duplicates the communicator, so all ranks have been in it.
///
/// Collective over `user`: one duplication, one reduction. Throws Error on all ranks alike.
bool create_state(const Zoltan_Struct* zz, MPI_Comm user);

/// Copies the state of one handle to another, if the plug-in has it.
///
/// Collective over the communicator of `from`, as Zoltan_Copy_To is: one reduction, and a
/// duplication if `to` has no communicator like it. Throws Error on all ranks alike.
void copy_state(const Zoltan_Struct* to, const Zoltan_Struct* from);

}  // namespace rrcb::zoltan
