#include "workspace_mpi.hpp"

#include "collective/attribute_mpi.hpp"
#include "collective/duplicate.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

#include <memory>

namespace rrcb {

using Kept = mpi::Attribute<Workspace>;

Workspace& workspace_of(MPI_Comm duplicate) {
    if (Workspace* found = Kept::find(duplicate)) return *found;
    return *Kept::keep(std::make_unique<Workspace>(), duplicate);
}

void release_buffers(MPI_Comm comm) {
    if (comm == MPI_COMM_NULL)
        throw Error(ErrorCode::invalid_argument,
                    "MPI_COMM_NULL keeps no buffers; give the communicator of the calls");
    mpi::check_is_running();
    const MPI_Comm* duplicate = mpi::find_duplicate(comm);
    if (duplicate != nullptr && Kept::find(*duplicate) != nullptr)
        mpi::check(Kept::forget(*duplicate), "MPI_Comm_delete_attr");
}

}  // namespace rrcb
