#include "collective/meeting_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/watch_mpi.hpp"

#include <algorithm>
#include <optional>

namespace rrcb {

int wait_watched(MPI_Request& request, CallLog& log) {
    std::optional<mpi::Watch> watch;
    while (true) {
        int is_done = 0;
        const int code = MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        if (is_done != 0 || code != MPI_SUCCESS) return code;
        if (!watch) watch.emplace(log);
        watch->look();
    }
}

void wait(MPI_Request& request, const char* call, Participant& self) {
    self.check(self.is_meeting() ? wait_watched(request, *self.log)
                                 : MPI_Wait(&request, MPI_STATUS_IGNORE),
               call);
}

void receive(std::span<std::byte> bytes, int from, mpi::Tag kind, Participant& self) {
    const auto count = static_cast<int>(bytes.size());
    MPI_Request request = MPI_REQUEST_NULL;
    self.check(MPI_Irecv(bytes.data(), count, MPI_BYTE, from, self.tag(kind), self.comm, &request),
               "MPI_Irecv");
    try {
        wait(request, "MPI_Irecv", self);
    } catch (...) {
        // The memory of the message is about to be freed.
        MPI_Cancel(&request);
        MPI_Wait(&request, MPI_STATUS_IGNORE);
        throw;
    }
}

void send(std::span<const std::byte> bytes, int to, mpi::Tag kind, Participant& self) {
    MPI_Request request = MPI_REQUEST_NULL;
    self.check(MPI_Isend(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, self.tag(kind),
                         self.comm, &request),
               "MPI_Isend");
    wait(request, "MPI_Isend", self);
}

void broadcast_and_meet(std::span<std::byte> bytes, Participant& self) {
    // Rank 0 begins the broadcast after all ranks have reported to it. Until then nothing is
    // written to the memory of the other ranks, so they may leave the broadcast pending.
    while (self.is_meeting() && !bytes.empty()) {
        const std::size_t size = std::min(bytes.size(), mpi::longest_message);
        MPI_Request request = MPI_REQUEST_NULL;
        const int code =
            MPI_Ibcast(bytes.data(), static_cast<int>(size), MPI_BYTE, root, self.comm, &request);
        const int code_of_wait = wait_watched(request, *self.log);
        mpi::check(code, "MPI_Ibcast");
        mpi::check(code_of_wait, "MPI_Ibcast");
        bytes = bytes.subspan(size);
    }
    note_met(self);
    mpi::broadcast(bytes, root, self.comm);
}

void note_met(Participant& self) {
    if (!self.is_meeting()) return;
    self.log->is_meeting = false;
    // Receives the reports of ranks that had to wait. If there is no memory for them, the next call
    // receives them.
    attempt([&] { mpi::take_reports(*self.log); });
}

}  // namespace rrcb
