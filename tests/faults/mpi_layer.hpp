#pragma once

#include <mpi.h>

#include <cstdint>

/// A layer between a program and MPI, by MPI's profiling interface. It is preloaded or linked, in
/// tests only.
namespace mpi_layer {

/// What all ranks of a collective call must have in common.
struct Call {
    char name[28] = "";
    std::int32_t root = -1;
    std::int64_t bytes = 0;  ///< 0 where ranks may give different lengths
};

Call call_of(const char* name, int root = -1, std::int64_t bytes = 0);
std::int64_t bytes_of(int count, MPI_Datatype type);

/// With RRCB_TEST_SEQUENCE in the environment: ends the program with a message naming what each
/// rank calls when the ranks differ, instead of leaving it to hang. Collective on communicators
/// as large as MPI_COMM_WORLD, without effect on others.
void check_sequence(const Call& call, MPI_Comm comm);
void start_checking();
void stop_checking();

/// Makes the `number`-th collective call from now on, counted from 1, return MPI_ERR_OTHER on this
/// rank after it was carried out; 0 fails none. Counted are calls under MPI_ERRORS_RETURN.
__attribute__((visibility("default"))) void fail_call(long number);

/// How many calls were counted since fail_call.
__attribute__((visibility("default"))) long counted_calls();

/// The same for messages between two ranks, sent or received, which the ranks have in different
/// numbers.
__attribute__((visibility("default"))) void fail_message(long number);
__attribute__((visibility("default"))) long counted_messages();

/// The same for calls that make or set something on this rank alone: types, reductions, attributes.
/// The one that fails is not carried out.
__attribute__((visibility("default"))) void fail_local_call(long number);
__attribute__((visibility("default"))) long counted_local_calls();

/// Bytes of the longest broadcast or message between two ranks since fail_call, on this rank.
__attribute__((visibility("default"))) std::int64_t longest_message();

/// From now on some calls on this rank, chosen by `seed`, begin up to a millisecond late; 0 ends
/// that.
__attribute__((visibility("default"))) void delay_calls(std::uint64_t seed);

void delay();
void note_message(std::int64_t bytes);
int after_call(int code, MPI_Comm comm);
int after_message(int code, MPI_Comm comm);
bool next_local_call_fails();

template <typename Body>
int collective(const Call& call, MPI_Comm comm, Body body) {
    check_sequence(call, comm);
    delay();
    return after_call(body(), comm);
}

template <typename Body>
int message(MPI_Comm comm, Body body) {
    delay();
    return after_message(body(), comm);
}

template <typename Body>
int local_call(Body body) {
    return next_local_call_fails() ? MPI_ERR_OTHER : body();
}

}  // namespace mpi_layer
