#include "agreement_mpi.hpp"

#include "mpi/communicator.hpp"

#include <new>
#include <string>

namespace rrcb {

void agree(const Member& me) {
    const int num_ranks = mpi::size_of(me.comm);
    int failing_rank = me.failure.failed ? mpi::rank_of(me.comm) : num_ranks;
    mpi::check(MPI_Allreduce(MPI_IN_PLACE, &failing_rank, 1, MPI_INT, MPI_MIN, me.comm),
               "MPI_Allreduce");
    if (failing_rank < num_ranks) fail_together(failing_rank, me);
}

void fail_together(int failing_rank, const Member& me) {
    Failure theirs = me.failure;
    mpi::check(MPI_Bcast(&theirs, sizeof theirs, MPI_BYTE, failing_rank, me.comm), "MPI_Bcast");
    try {
        throw Error(theirs.code,
                    "rank " + std::to_string(failing_rank) + ": " + theirs.text.data());
    } catch (const std::bad_alloc&) {
        throw Error(theirs.code);
    }
}

}  // namespace rrcb
