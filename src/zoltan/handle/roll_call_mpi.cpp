#include "zoltan/handle/roll_call_mpi.hpp"

#include "collective/communicator.hpp"
#include "collective/watch_mpi.hpp"
#include "zoltan/real/message.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace rrcb::zoltan {

namespace {

/// The largest tag that every MPI allows. The messages use the program's communicator, but only
/// when the program is about to get an error.
constexpr int roll_call_tag = 32767;

/// Number of tests within which ranks that run at the same time complete a request. Later tests
/// yield the processor; each yield to a busy thread may take milliseconds.
constexpr int tests_without_yield = 100;

double read_limit() {
    constexpr double default_seconds = 20;
    const char* text = std::getenv("RRCB_AGREE_SECONDS");
    if (text == nullptr || *text == '\0') return default_seconds;
    const std::string_view value(text);
    double seconds = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), seconds);
    const bool is_read = error == std::errc() && end == value.data() + value.size();
    if (is_read && seconds >= 0 && std::isfinite(seconds)) return seconds;
    print_warning(-1, "RRCB_AGREE_SECONDS", "not a number of seconds; 20 will be used");
    return default_seconds;
}

std::chrono::duration<double> limit() {
    static const std::chrono::duration<double> only(read_limit());
    return only;
}

}  // namespace

RollCall::RollCall(MPI_Comm comm) : comm_(comm), limit_(limit()) {}

bool RollCall::complete(MPI_Request request, Participant& self) {
    for (int tests = 1;; ++tests) {
        int is_done = 0;
        const int code = MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        self.check(code, "MPI_Test");
        if (is_done != 0 || code != MPI_SUCCESS) return true;
        if (is_missed()) break;
        if (tests >= tests_without_yield) mpi::pause(waited());
    }
    report();
    MPI_Comm_call_errhandler(comm_, MPI_ERR_OTHER);
    return false;
}

/// Returns true if some ranks do not take part. Removes the time limit if all ranks take part, even
/// if some are slow, and also if there is no memory.
bool RollCall::is_missed() {
    if (limit_.count() == 0) return false;
    const Seconds now = waited();
    if (present_.empty()) {
        // Messages of the roll call are not received earlier, because the program's own messages
        // may have the same tag.
        if (now < limit_ * 0.75) return false;
        if (attempt([&] { call_all(); }).failed) limit_ = {};
        end_ = now + limit_ / 4;
    }
    while (receive()) {
    }
    if (num_present_ == present_.size()) limit_ = {};
    return limit_.count() > 0 && now >= end_;
}

void RollCall::call_all() {
    const int rank = mpi::rank_of(comm_);
    present_.assign(mpi::size_of(comm_), 0);
    present_[rank] = 1;
    num_present_ = 1;
    for (int other = 0; other < std::ssize(present_); ++other)
        if (other != rank) call(other);
}

void RollCall::call(int rank) const {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(nullptr, 0, MPI_BYTE, rank, roll_call_tag, comm_, &request);
    if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
}

/// Receives a message of the roll call if one has arrived.
bool RollCall::receive() {
    int is_there = 0;
    MPI_Status status{};
    MPI_Iprobe(MPI_ANY_SOURCE, roll_call_tag, comm_, &is_there, &status);
    if (is_there == 0 || present_.empty()) return false;
    MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, roll_call_tag, comm_, MPI_STATUS_IGNORE);
    char& flag = present_[status.MPI_SOURCE];
    if (flag == 0) ++num_present_;
    flag = 1;
    return true;
}

/// Returns the ranks that do not take part, as "0, 2-5 of 8".
std::string RollCall::absent() const {
    std::string text;
    for (std::size_t i = 0; i < present_.size(); ++i) {
        if (present_[i] != 0) continue;
        const std::size_t first = i;
        while (i + 1 < present_.size() && present_[i + 1] == 0) ++i;
        if (!text.empty()) text += ", ";
        text += std::to_string(first);
        if (i > first) text += '-' + std::to_string(i);
    }
    return text + " of " + std::to_string(present_.size());
}

void RollCall::report() {
    const auto lowest = static_cast<int>(std::ranges::find(present_, 1) - present_.begin());
    const int rank = mpi::rank_of(comm_);
    if (rank != lowest) {
        // The lowest rank must have printed before this rank ends the program.
        int is_there = 0;
        const Seconds end = waited() + limit_ / 4;
        while (is_there == 0 && waited() < end)
            MPI_Iprobe(lowest, roll_call_tag, comm_, &is_there, MPI_STATUS_IGNORE);
        return;
    }
    const std::string text = "no RRCB on ranks " + absent() + ", which did not answer within " +
                             std::to_string(std::lround(limit_.count())) +
                             " s (RRCB_AGREE_SECONDS); load or link it on all ranks";
    print_error(rank, "Zoltan_Create", text);
    std::fflush(stderr);
    for (int other = 0; other < std::ssize(present_); ++other)
        if (present_[other] != 0 && other != rank) call(other);
}

}  // namespace rrcb::zoltan
