#pragma once

#include <mpi.h>
#include <zoltan.h>

namespace rrcb::zoltan {

/// Adds a new handle to the side table, on all ranks or on none.
///
/// It is added on no rank if Zoltan's functions come from several libraries on any rank. If
/// RRCB_REPLACE is set on one rank, it applies to all ranks.
///
/// Returns false if some ranks do not run the plug-in, which RollCall has then reported. The real
/// Zoltan_Create must have returned before: it duplicates the communicator, so all ranks have been
/// in it.
///
/// Collective over `user`: one duplication and one reduction. Throws the same Error on all ranks.
bool create_state(const Zoltan_Struct* zz, MPI_Comm user);

/// Copies the state of one handle to another, if the plug-in has a state for it.
///
/// Collective over the communicator of `from`, as Zoltan_Copy_To is: one reduction, and one
/// duplication if `to` has no congruent communicator. Throws the same Error on all ranks.
void copy_state(const Zoltan_Struct* to, const Zoltan_Struct* from);

}  // namespace rrcb::zoltan
