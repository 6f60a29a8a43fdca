#include "mpi_layer.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>
#include <vector>

namespace mpi_layer {

namespace {

MPI_Comm checking_comm = MPI_COMM_NULL;
long num_checked = 0;

/// Calls of one kind: how many there were, and which of them fails.
struct Counter {
    long failing = 0;
    long counted = 0;

    int after(int code, MPI_Comm comm);
};

Counter collectives;
Counter messages;
Counter local_calls;
std::int64_t longest = 0;
std::uint64_t delays = 0;  ///< state of the sequence they are taken from

int size_of(MPI_Comm comm) {
    int size = 0;
    PMPI_Comm_size(comm, &size);
    return size;
}

int rank_here() {
    int rank = 0;
    PMPI_Comm_rank(checking_comm, &rank);
    return rank;
}

/// FNV-1a.
std::int64_t hash_of(const Call& call) {
    unsigned char bytes[sizeof(Call)];
    std::memcpy(bytes, &call, sizeof(Call));
    std::uint64_t hash = 14695981039346656037U;
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211U;
    return static_cast<std::int64_t>(hash);
}

bool same_on_all_ranks(const Call& call) {
    const std::int64_t hash = hash_of(call);
    std::int64_t largest[2] = {hash, ~hash};
    PMPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_INT64_T, MPI_MAX, checking_comm);
    return largest[0] == ~largest[1];
}

[[noreturn]] void report_and_abort(const Call& mine) {
    std::vector<Call> calls(static_cast<std::size_t>(size_of(checking_comm)));
    PMPI_Gather(&mine, sizeof(Call), MPI_BYTE, calls.data(), sizeof(Call), MPI_BYTE, 0,
                checking_comm);
    if (rank_here() == 0) {
        std::fprintf(stderr, "collective call %ld differs between ranks:\n", num_checked);
        for (std::size_t rank = 0; rank < calls.size(); ++rank) {
            std::fprintf(stderr, "  rank %zu: %s, root %d, %lld bytes\n", rank, calls[rank].name,
                         calls[rank].root, static_cast<long long>(calls[rank].bytes));
        }
        std::fflush(stderr);
    }
    PMPI_Barrier(checking_comm);
    PMPI_Abort(MPI_COMM_WORLD, 1);
    std::abort();
}

bool returns_errors(MPI_Comm comm) {
    MPI_Errhandler handler = MPI_ERRHANDLER_NULL;
    PMPI_Comm_get_errhandler(comm, &handler);
    const bool returns = handler == MPI_ERRORS_RETURN;
    PMPI_Errhandler_free(&handler);
    return returns;
}

int Counter::after(int code, MPI_Comm comm) {
    if (comm == MPI_COMM_NULL || !returns_errors(comm)) return code;
    return ++counted == failing ? MPI_ERR_OTHER : code;
}

}  // namespace

Call call_of(const char* name, int root, std::int64_t bytes) {
    Call call;
    std::string_view(name).copy(call.name, sizeof call.name - 1);
    call.root = root;
    call.bytes = bytes;
    return call;
}

std::int64_t bytes_of(int count, MPI_Datatype type) {
    int size = 0;
    PMPI_Type_size(type, &size);
    return std::int64_t{count} * size;
}

void check_sequence(const Call& call, MPI_Comm comm) {
    if (checking_comm == MPI_COMM_NULL || size_of(comm) != size_of(checking_comm)) return;
    ++num_checked;
    if (!same_on_all_ranks(call)) report_and_abort(call);
}

void start_checking() {
    if (std::getenv("RRCB_TEST_SEQUENCE") == nullptr) return;
    PMPI_Comm_dup(MPI_COMM_WORLD, &checking_comm);
}

void stop_checking() {
    if (checking_comm == MPI_COMM_NULL) return;
    if (rank_here() == 0) {
        std::printf("%ld collective calls, the same on %d ranks\n", num_checked,
                    size_of(checking_comm));
    }
    PMPI_Comm_free(&checking_comm);
}

void fail_call(long number) {
    collectives = {number, 0};
    longest = 0;
}

long counted_calls() {
    return collectives.counted;
}

void fail_message(long number) {
    messages = {number, 0};
}

long counted_messages() {
    return messages.counted;
}

void fail_local_call(long number) {
    local_calls = {number, 0};
}

long counted_local_calls() {
    return local_calls.counted;
}

void delay_calls(std::uint64_t seed) {
    delays = seed;
}

void delay() {
    if (delays == 0) return;
    // Marsaglia's xorshift; one call in 32, and short delays more often than long ones.
    delays ^= delays << 13;
    delays ^= delays >> 7;
    delays ^= delays << 17;
    if ((delays & 31) != 0) return;
    const auto microseconds = 1L << (delays >> 32) % 11;
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
}

std::int64_t longest_message() {
    return longest;
}

void note_message(std::int64_t bytes) {
    longest = std::max(longest, bytes);
}

int after_call(int code, MPI_Comm comm) {
    return collectives.after(code, comm);
}

int after_message(int code, MPI_Comm comm) {
    return messages.after(code, comm);
}

bool next_local_call_fails() {
    return ++local_calls.counted == local_calls.failing;
}

}  // namespace mpi_layer
