#include "c/balancer.hpp"
#include "c/for_fortran.h"
#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"
#include "collective/watch_mpi.hpp"

#include <chrono>
#include <vector>

namespace {

using rrcb::c::Origin;

/// Calls is_done() until it returns true or the time `limit` has passed. Returns its last result.
template <class Test>
bool wait_for(std::chrono::duration<double> limit, Test&& is_done) {
    const auto start = std::chrono::steady_clock::now();
    for (;;) {
        if (is_done()) return true;
        const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - start;
        if (waited > limit) return false;
        rrcb::mpi::pause(waited);
    }
}

/// Returns the communicator of the failed call's messages; MPI_COMM_NULL if the call had none.
MPI_Comm comm_of(const Origin& origin) {
    if (origin.comm == MPI_COMM_NULL || !rrcb::mpi::is_running()) return MPI_COMM_NULL;
    const MPI_Comm* found = rrcb::mpi::find_duplicate(origin.comm);
    return found == nullptr ? MPI_COMM_NULL : *found;
}

}  // namespace

int rrcb_prints_last_error(void) {
    const Origin origin = rrcb::c::origin_of_last_failure();
    const MPI_Comm comm = comm_of(origin);
    if (comm == MPI_COMM_NULL || rrcb::mpi::rank_of(comm) == 0) return 1;
    MPI_Request printed = MPI_REQUEST_NULL;
    MPI_Irecv(nullptr, 0, MPI_BYTE, 0, rrcb::mpi::printed_tag, comm, &printed);
    return wait_for(origin.patience,
                    [&] {
                        int is_done = 0;
                        MPI_Test(&printed, &is_done, MPI_STATUS_IGNORE);
                        return is_done != 0;
                    })
               ? 0
               : 1;
}

void rrcb_note_printed_error(void) {
    const Origin origin = rrcb::c::origin_of_last_failure();
    const MPI_Comm comm = comm_of(origin);
    if (comm == MPI_COMM_NULL || rrcb::mpi::rank_of(comm) != 0) return;
    const rrcb::Failure no_memory = rrcb::attempt([&] {
        std::vector<MPI_Request> sends(static_cast<std::size_t>(rrcb::mpi::size_of(comm) - 1),
                                       MPI_REQUEST_NULL);
        for (std::size_t k = 0; k < sends.size(); ++k)
            MPI_Issend(nullptr, 0, MPI_BYTE, static_cast<int>(k + 1), rrcb::mpi::printed_tag, comm,
                       &sends[k]);
        wait_for(origin.patience, [&] {
            int are_done = 0;
            MPI_Testall(static_cast<int>(sends.size()), sends.data(), &are_done,
                        MPI_STATUSES_IGNORE);
            return are_done != 0;
        });
    });
    static_cast<void>(no_memory);
}
