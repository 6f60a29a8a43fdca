#include "collective/deadline_mpi.hpp"

#include "collective/communicator.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <thread>

namespace rrcb {

using namespace std::chrono_literals;

namespace {

/// Tests of a request in which ranks that run at the same time complete it. Each yield to a busy
/// thread may take milliseconds.
constexpr int tests_without_yield = 100;

}  // namespace

std::optional<double> agree_seconds() {
    const char* text = std::getenv("RRCB_AGREE_SECONDS");
    if (text == nullptr || *text == '\0') return std::nullopt;
    const std::string_view value(text);
    double seconds = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), seconds);
    const bool is_read = error == std::errc() && end == value.data() + value.size();
    if (is_read && seconds >= 0 && std::isfinite(seconds)) return seconds;
    return std::numeric_limits<double>::quiet_NaN();
}

void pause(std::chrono::duration<double> waited) {
    if (waited < short_wait) {
        std::this_thread::yield();
    } else {
        std::this_thread::sleep_for(100us);
    }
}

Deadline::Deadline(MPI_Comm comm, int tag, std::chrono::duration<double> limit, bool answers)
    : comm_(comm), tag_(tag), limit_(limit), answers_(answers), end_(limit) {}

bool Deadline::complete(MPI_Request& request, Participant& self) {
    for (int tests = 1;; ++tests) {
        int is_done = 0;
        const int code = MPI_Test(&request, &is_done, MPI_STATUS_IGNORE);
        self.check(code, "MPI_Test");
        if (is_done != 0 || code != MPI_SUCCESS) return true;
        if (is_missed()) return false;
        if (tests >= tests_without_yield) pause(waited());
    }
}

bool Deadline::is_missed() {
    if (limit_.count() == 0) return false;
    const auto now = waited();
    if (present_.empty()) {
        if (now < limit_ * 0.75 && !(answers_ && receive())) return false;
        if (attempt([&] { call_all(); }).failed) limit_ = {};
        end_ = now + limit_ / 4;
    }
    while (receive()) {
    }
    if (num_present_ == present_.size()) limit_ = {};
    return limit_.count() > 0 && now >= end_;
}

void Deadline::call_all() {
    const int rank = mpi::rank_of(comm_);
    present_.assign(mpi::size_of(comm_), 0);
    present_[rank] = 1;
    num_present_ = 1;
    for (int other = 0; other < std::ssize(present_); ++other)
        if (other != rank) call(other);
}

void Deadline::call(int rank) const {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(nullptr, 0, MPI_BYTE, rank, tag_, comm_, &request);
    if (request != MPI_REQUEST_NULL) MPI_Request_free(&request);
}

/// Receives a message of the roll call; before this rank's own, it only looks for one.
bool Deadline::receive() {
    int is_there = 0;
    MPI_Status status{};
    MPI_Iprobe(MPI_ANY_SOURCE, tag_, comm_, &is_there, &status);
    if (is_there == 0 || present_.empty()) return is_there != 0;
    MPI_Recv(nullptr, 0, MPI_BYTE, status.MPI_SOURCE, tag_, comm_, MPI_STATUS_IGNORE);
    char& flag = present_[status.MPI_SOURCE];
    if (flag == 0) ++num_present_;
    flag = 1;
    return true;
}

std::string Deadline::absent() const {
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

}  // namespace rrcb
