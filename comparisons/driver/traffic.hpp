#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace comparisons {

/// The traffic of one rank's MPI calls.
///
/// A point-to-point message counts once, at its sender, with its bytes. A collective call counts as
/// one message on each rank that takes part, with the bytes that the rank passes in and gets out.
/// The sum over the ranks is the total.
///
/// `root_bytes_in` are the bytes that rank 0 of MPI_COMM_WORLD receives. They are counted at the
/// sender, or at rank 0 as the output of a collective. `collectives` is the number of messages that
/// are collective. `communicators` is the number of calls that create a communicator; their
/// internal messages are not counted. `seconds_in_mpi` is the processor time inside MPI, plus the
/// time from each MPI_Test that finds an unfinished request to the next call.
struct Traffic {
    std::int64_t messages = 0;
    std::int64_t bytes = 0;
    std::int64_t root_bytes_in = 0;
    std::int64_t collectives = 0;
    std::int64_t communicators = 0;
    double seconds_in_mpi = 0;
};

/// Returns the processor time of this thread, in s. Not collective.
double processor_seconds();

/// The traffic of one MPI function on one rank.
struct CallCount {
    std::int64_t calls = 0;
    std::int64_t bytes_in = 0;   ///< passed in
    std::int64_t bytes_out = 0;  ///< returned; 0 for messages, whose sender counts them
};

/// Returns the names of the counted functions. Not collective.
std::span<const char* const> counted_functions();

/// Returns the counts since counting started, by the name of the function. Not collective.
std::map<std::string, CallCount> counted_calls();

/// Starts counting from zero on this rank. Not collective.
///
/// The counters are MPI functions of this program that replace those of the MPI library and call
/// its profiling interface (PMPI). They count the calls of all libraries.
void start_counting_traffic();

/// Stops counting on this rank. Not collective.
Traffic stop_counting_traffic();

/// Makes MPI_Comm_split_type treat every `number` consecutive ranks of MPI_COMM_WORLD as one
/// machine. Not collective, but all ranks must pass the same number.
void set_ranks_per_machine(int number);

}  // namespace comparisons
