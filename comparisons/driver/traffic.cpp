#include "traffic.hpp"

#include <mpi.h>

#include <algorithm>
#include <ctime>
#include <numeric>

namespace comparisons {

namespace {

bool counting = false;
int ranks_per_machine = 0;  ///< 0: the machines that the ranks are on
Traffic traffic;
std::map<std::string, CallCount> calls;

int rank_in(MPI_Comm comm) {
    int rank = 0;
    PMPI_Comm_rank(comm, &rank);
    return rank;
}

int size_of(MPI_Comm comm) {
    int size = 0;
    PMPI_Comm_size(comm, &size);
    return size;
}

std::int64_t sum(const int counts[], MPI_Comm comm) {
    return std::accumulate(counts, counts + size_of(comm), std::int64_t{0});
}

std::int64_t bytes_of(std::int64_t count, MPI_Datatype type) {
    int size = 0;
    PMPI_Type_size(type, &size);
    return count * size;
}

int world_rank(int rank, MPI_Comm comm) {
    MPI_Group group = MPI_GROUP_NULL;
    MPI_Group world = MPI_GROUP_NULL;
    int translated = MPI_UNDEFINED;
    PMPI_Comm_group(comm, &group);
    PMPI_Comm_group(MPI_COMM_WORLD, &world);
    PMPI_Group_translate_ranks(group, 1, &rank, world, &translated);
    PMPI_Group_free(&group);
    PMPI_Group_free(&world);
    return translated;
}

void count_call(const char* function, std::int64_t bytes_in, std::int64_t bytes_out) {
    CallCount& count = calls[function];
    ++count.calls;
    count.bytes_in += bytes_in;
    count.bytes_out += bytes_out;
}

void count_message(const char* function, std::int64_t bytes, int to, MPI_Comm comm) {
    count_call(function, bytes, 0);
    ++traffic.messages;
    traffic.bytes += bytes;
    if (world_rank(to, comm) == 0) traffic.root_bytes_in += bytes;
}

void count_collective(const char* function, std::int64_t bytes_in, std::int64_t bytes_out) {
    count_call(function, bytes_in, bytes_out);
    ++traffic.messages;
    ++traffic.collectives;
    traffic.bytes += bytes_in + bytes_out;
    if (rank_in(MPI_COMM_WORLD) == 0) traffic.root_bytes_in += bytes_out;
}

void count_communicator(const char* function) {
    count_call(function, 0, 0);
    ++traffic.communicators;
}

/// Returns the time that reading the clock takes: the shortest of several readings.
double reading_seconds() {
    double least = 1;
    for (int i = 0; i < 1000; ++i) {
        const double start = processor_seconds();
        least = std::min(least, processor_seconds() - start);
    }
    return least;
}

double clock_s = 0;     ///< reading_seconds(), once it has been measured
double last_end_s = 0;  ///< end of the last call
bool polls = false;     ///< the last call found an unfinished request, so a loop is waiting for it

/// Adds the processor time of its scope to the time in MPI while traffic is counted. Also adds the
/// time that reading the clock takes outside the scope, and the time since the last call if a loop
/// is waiting.
class InMpi {
  public:
    InMpi() {
        if (!counting) return;
        start_ = polls ? last_end_s : processor_seconds();
        polls = false;
    }
    ~InMpi() {
        if (!counting) return;
        last_end_s = processor_seconds();
        traffic.seconds_in_mpi += last_end_s - start_ + clock_s;
    }
    InMpi(const InMpi&) = delete;
    InMpi& operator=(const InMpi&) = delete;

  private:
    double start_ = 0;
};

}  // namespace

std::span<const char* const> counted_functions() {
    static constexpr const char* names[] = {
#define COLLECTIVE(name, ...) "MPI_" #name,
#define COMMUNICATOR COLLECTIVE
#define SEND COLLECTIVE
#include "mpi_functions.inc"
    };
    return names;
}

std::map<std::string, CallCount> counted_calls() {
    return calls;
}

void start_counting_traffic() {
    traffic = {};
    calls.clear();
    polls = false;
    if (!(clock_s > 0)) clock_s = reading_seconds();
    counting = true;
}

Traffic stop_counting_traffic() {
    counting = false;
    return traffic;
}

void set_ranks_per_machine(int number) {
    ranks_per_machine = number;
}

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace comparisons

using namespace comparisons;

extern "C" {

#define FUNCTION(name, parameters, arguments, count_it) \
    int MPI_##name parameters {                         \
        const InMpi in_mpi;                             \
        if (counting) count_it;                         \
        return PMPI_##name arguments;                   \
    }
#define COLLECTIVE(name, parameters, arguments, root, same, in, out) \
    FUNCTION(name, parameters, arguments, count_collective(__func__, in, out))
#define COMMUNICATOR(name, parameters, arguments) \
    FUNCTION(name, parameters, arguments, count_communicator(__func__))
#define SEND(name, parameters, arguments) \
    FUNCTION(name, parameters, arguments, \
             if (to != MPI_PROC_NULL) count_message(__func__, bytes_of(count, type), to, comm))
// These functions are not counted as traffic, but a rank may wait in them.
#define RECEIVE(name, parameters, arguments) FUNCTION(name, parameters, arguments, (void)0)
#define WAIT RECEIVE
#include "mpi_functions.inc"

int MPI_Comm_split_type(MPI_Comm comm, int type, int key, MPI_Info info, MPI_Comm* made) {
    const InMpi in_mpi;
    if (counting) count_communicator(__func__);
    if (ranks_per_machine == 0 || type != MPI_COMM_TYPE_SHARED)
        return PMPI_Comm_split_type(comm, type, key, info, made);
    return PMPI_Comm_split(comm, rank_in(MPI_COMM_WORLD) / ranks_per_machine, key, made);
}

int MPI_Test(MPI_Request* request, int* is_done, MPI_Status* status) {
    const InMpi in_mpi;
    const int code = PMPI_Test(request, is_done, status);
    polls = counting && *is_done == 0;
    return code;
}

FUNCTION(Comm_free, (MPI_Comm * comm), (comm), (void)0)

}  // extern "C"
