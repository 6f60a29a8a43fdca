#include "zoltan/handle/roll_call_mpi.hpp"

#include "collective/communicator.hpp"
#include "zoltan/real/message.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <thread>

namespace rrcb::zoltan {

using namespace std::chrono_literals;

namespace {

/// Greatest tag that every MPI allows. It is used on the caller's communicator only when the
/// program is about to end.
constexpr int roll_call_tag = 32767;

/// Tests of a request in which ranks that run at the same time complete it.
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

void send_call(int to, MPI_Comm comm) {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(nullptr, 0, MPI_BYTE, to, roll_call_tag, comm, &request);
    if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
}

/// The ranks without a flag, as "0, 2-5".
std::string list_absent(const std::vector<char>& present) {
    std::string text;
    for (std::size_t i = 0; i < present.size(); ++i) {
        if (present[i] != 0) continue;
        const std::size_t first = i;
        while (i + 1 < present.size() && present[i + 1] == 0) ++i;
        if (!text.empty()) text += ", ";
        text += std::to_string(first);
        if (i > first) text += '-' + std::to_string(i);
    }
    return text;
}

}  // namespace

RollCall::RollCall(MPI_Comm comm) : comm_(comm), start_(Clock::now()), limit_(limit()) {}

template <typename Enough>
bool RollCall::test_until(Clock::time_point end, MPI_Request& request, Participant& self,
                          Enough enough) {
    for (int tests = 1;; ++tests) {
        int done = 0;
        const int code = MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        self.check(code, "MPI_Test");
        if (done != 0 || code != MPI_SUCCESS) return true;
        const auto now = Clock::now();
        if (enough() || now >= end) return false;
        // Each yield to a busy thread may take milliseconds.
        if (tests < tests_without_yield) continue;
        if (now < start_ + 10ms) {
            std::this_thread::yield();
        } else {
            std::this_thread::sleep_for(100us);
        }
    }
}

bool RollCall::receive_call() {
    int is_there = 0;
    MPI_Status status{};
    MPI_Iprobe(MPI_ANY_SOURCE, roll_call_tag, comm_, &is_there, &status);
    if (is_there == 0) return false;
    MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, roll_call_tag, comm_, MPI_STATUS_IGNORE);
    char& flag = present_[status.MPI_SOURCE];
    const bool is_first = flag == 0;
    flag = 1;
    num_present_ += is_first ? 1 : 0;
    return true;
}

bool RollCall::call_ranks(MPI_Request& request, Participant& self) {
    const int rank = mpi::rank_of(comm_);
    present_.assign(mpi::size_of(comm_), 0);
    present_[rank] = 1;
    num_present_ = 1;
    for (int other = 0; other < mpi::size_of(comm_); ++other)
        if (other != rank) send_call(other, comm_);
    const auto end = start_ + std::chrono::duration_cast<Clock::duration>(limit_);
    return test_until(end, request, self, [&] {
        while (receive_call()) {
        }
        return num_present_ == present_.size();
    });
}

void RollCall::report() {
    const auto lowest = static_cast<int>(std::ranges::find(present_, 1) - present_.begin());
    const int rank = mpi::rank_of(comm_);
    if (rank != lowest) {
        // That rank is to print before this one ends the program.
        int is_there = 0;
        const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit_ / 4);
        while (is_there == 0 && Clock::now() < end)
            MPI_Iprobe(lowest, roll_call_tag, comm_, &is_there, MPI_STATUS_IGNORE);
        return;
    }
    const std::string text = "no RRCB on ranks " + list_absent(present_) + " of " +
                             std::to_string(present_.size()) + ", which did not answer within " +
                             std::to_string(std::lround(limit_.count())) +
                             " s (RRCB_AGREE_SECONDS); load or link it on all ranks";
    print_error(rank, "Zoltan_Create", text);
    std::fflush(stderr);
    for (std::size_t other = 0; other < present_.size(); ++other)
        if (present_[other] != 0 && static_cast<int>(other) != rank)
            send_call(static_cast<int>(other), comm_);
}

bool RollCall::complete(MPI_Request request, Participant& self) {
    const auto never = [] { return false; };
    if (limit_.count() == 0) return test_until(Clock::time_point::max(), request, self, never);
    const auto end = start_ + std::chrono::duration_cast<Clock::duration>(limit_ * 0.75);
    if (test_until(end, request, self, never)) return true;
    if (call_ranks(request, self)) return true;
    // All have the plug-in: some are only slow.
    if (num_present_ == present_.size())
        return test_until(Clock::time_point::max(), request, self, never);
    report();
    MPI_Comm_call_errhandler(comm_, MPI_ERR_OTHER);
    return false;
}

}  // namespace rrcb::zoltan
