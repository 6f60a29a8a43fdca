#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace comparisons {

/// What one rank's MPI calls moved.
///
/// A point-to-point message counts once, at its sender, with its bytes. A collective counts one
/// message on each rank that takes part, with the bytes the rank hands in and the bytes it gets
/// out. `root_bytes_in` is what rank 0 of MPI_COMM_WORLD receives, counted where it is known:
/// at the sender, or as what rank 0 gets out of a collective. Summed over the ranks these are the
/// totals. `collectives` are those among the messages; `communicators` are the calls that make
/// one, whose messages and bytes are the MPI library's own affair. `seconds_in_mpi` is the
/// processor time inside MPI, and from an MPI_Test that finds a request undone to the next call.
struct Traffic {
    std::int64_t messages = 0;
    std::int64_t bytes = 0;
    std::int64_t root_bytes_in = 0;
    std::int64_t collectives = 0;
    std::int64_t communicators = 0;
    double seconds_in_mpi = 0;
};

/// Processor time this thread has used, in s; not collective.
double processor_seconds();

/// What the calls of one MPI function moved on one rank.
struct CallCount {
    std::int64_t calls = 0;
    std::int64_t bytes_in = 0;   ///< handed in
    std::int64_t bytes_out = 0;  ///< got out; of a message 0, since its sender counts it
};

/// Names of the functions that are counted. Not collective.
std::span<const char* const> counted_functions();

/// By the name of the function, what was counted since counting started. Not collective.
std::map<std::string, CallCount> counted_calls();

/// Starts counting on this rank, from zero. Not collective.
///
/// The counters are MPI functions of this program that shadow those of the MPI library and call
/// its profiling interface (PMPI); they count whatever library makes the call.
void start_counting_traffic();

/// Stops counting on this rank. Not collective.
Traffic stop_counting_traffic();

/// Makes MPI_Comm_split_type put so many consecutive ranks of MPI_COMM_WORLD on each machine. Not
/// collective, but the same on every rank.
void set_ranks_per_machine(int number);

}  // namespace comparisons
