#include "zoltan/handle/roll_call_mpi.hpp"

#include "collective/communicator.hpp"
#include "zoltan/real/message.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace rrcb::zoltan {

namespace {

double read_limit() {
    constexpr double default_seconds = 20;
    const double seconds = agree_seconds().value_or(default_seconds);
    if (!std::isnan(seconds)) return seconds;
    print_warning(-1, "RRCB_AGREE_SECONDS", "not a number of seconds; 20 will be used");
    return default_seconds;
}

std::chrono::duration<double> limit() {
    static const std::chrono::duration<double> only(read_limit());
    return only;
}

}  // namespace

// The program's own messages may have any tag, so the roll call must not look for others earlier.
RollCall::RollCall(MPI_Comm comm)
    : comm_(comm), deadline_(comm, mpi::roll_call_tag_of_user, limit(), false) {}

void RollCall::report() {
    const std::vector<char>& present = deadline_.present();
    const auto lowest = static_cast<int>(std::ranges::find(present, 1) - present.begin());
    const int rank = mpi::rank_of(comm_);
    if (rank != lowest) {
        // That rank is to print before this one ends the program.
        int is_there = 0;
        const auto end = deadline_.waited() + deadline_.limit() / 4;
        while (is_there == 0 && deadline_.waited() < end)
            MPI_Iprobe(lowest, mpi::roll_call_tag_of_user, comm_, &is_there, MPI_STATUS_IGNORE);
        return;
    }
    const std::string text = "no RRCB on ranks " + deadline_.absent() +
                             ", which did not answer within " +
                             std::to_string(std::lround(deadline_.limit().count())) +
                             " s (RRCB_AGREE_SECONDS); load or link it on all ranks";
    print_error(rank, "Zoltan_Create", text);
    std::fflush(stderr);
    for (int other = 0; other < std::ssize(present); ++other)
        if (present[other] != 0 && other != rank) deadline_.call(other);
}

bool RollCall::complete(MPI_Request request, Participant& self) {
    if (deadline_.complete(request, self)) return true;
    report();
    MPI_Comm_call_errhandler(comm_, MPI_ERR_OTHER);
    return false;
}

}  // namespace rrcb::zoltan
