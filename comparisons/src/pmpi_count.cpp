#include "pmpi_count.hpp"

#include "traffic.hpp"

#include <ctime>

namespace comparisons {

namespace {

bool counting = false;
Traffic traffic;
std::map<std::string, CallCount> calls;

void note_call(const char* function, std::int64_t bytes_in, std::int64_t bytes_out) {
    CallCount& count = calls[function];
    ++count.calls;
    count.bytes_in += bytes_in;
    count.bytes_out += bytes_out;
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

}  // namespace

bool counting_traffic() {
    return counting;
}

void start_counting_traffic() {
    traffic = {};
    calls.clear();
    counting = true;
}

std::map<std::string, CallCount> counted_calls() {
    return calls;
}

Traffic stop_counting_traffic() {
    counting = false;
    return traffic;
}

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::int64_t bytes_of(std::int64_t count, MPI_Datatype type) {
    int size = 0;
    PMPI_Type_size(type, &size);
    return count * size;
}

void count_message(const char* function, int count, MPI_Datatype type, int destination,
                   MPI_Comm comm) {
    if (!counting || destination == MPI_PROC_NULL) return;
    const std::int64_t bytes = bytes_of(count, type);
    note_call(function, bytes, 0);
    ++traffic.messages;
    traffic.bytes += bytes;
    if (world_rank(destination, comm) == 0) traffic.root_bytes_in += bytes;
}

InMpi::InMpi() {
    if (counting) start_ = processor_seconds();
}

InMpi::~InMpi() {
    if (counting) traffic.seconds_in_mpi += processor_seconds() - start_;
}

void count_communicator(const char* function) {
    if (!counting) return;
    note_call(function, 0, 0);
    ++traffic.communicators;
}

void count_collective(const char* function, std::int64_t bytes_in, std::int64_t bytes_out) {
    note_call(function, bytes_in, bytes_out);
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    ++traffic.messages;
    ++traffic.collectives;
    traffic.bytes += bytes_in + bytes_out;
    if (rank == 0) traffic.root_bytes_in += bytes_out;
}

}  // namespace comparisons

using comparisons::count_message;
using comparisons::InMpi;

extern "C" {

int MPI_Send(const void* data, int count, MPI_Datatype type, int destination, int tag,
             MPI_Comm comm) {
    const InMpi in_mpi;
    count_message(__func__, count, type, destination, comm);
    return PMPI_Send(data, count, type, destination, tag, comm);
}

int MPI_Ssend(const void* data, int count, MPI_Datatype type, int destination, int tag,
              MPI_Comm comm) {
    const InMpi in_mpi;
    count_message(__func__, count, type, destination, comm);
    return PMPI_Ssend(data, count, type, destination, tag, comm);
}

int MPI_Rsend(const void* data, int count, MPI_Datatype type, int destination, int tag,
              MPI_Comm comm) {
    const InMpi in_mpi;
    count_message(__func__, count, type, destination, comm);
    return PMPI_Rsend(data, count, type, destination, tag, comm);
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int destination, int tag,
              MPI_Comm comm, MPI_Request* request) {
    const InMpi in_mpi;
    count_message(__func__, count, type, destination, comm);
    return PMPI_Isend(data, count, type, destination, tag, comm, request);
}

int MPI_Irsend(const void* data, int count, MPI_Datatype type, int destination, int tag,
               MPI_Comm comm, MPI_Request* request) {
    const InMpi in_mpi;
    count_message(__func__, count, type, destination, comm);
    return PMPI_Irsend(data, count, type, destination, tag, comm, request);
}

int MPI_Sendrecv(const void* data, int count, MPI_Datatype type, int destination, int tag,
                 void* received, int max_received, MPI_Datatype received_type, int source,
                 int received_tag, MPI_Comm comm, MPI_Status* status) {
    const InMpi in_mpi;
    count_message(__func__, count, type, destination, comm);
    return PMPI_Sendrecv(data, count, type, destination, tag, received, max_received, received_type,
                         source, received_tag, comm, status);
}

}  // extern "C"
