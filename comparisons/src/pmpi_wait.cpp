#include "pmpi_count.hpp"

// Calls that carry no traffic of their own, but in which a rank may wait.

using comparisons::InMpi;

extern "C" {

int MPI_Recv(void* data, int count, MPI_Datatype type, int source, int tag, MPI_Comm comm,
             MPI_Status* status) {
    const InMpi in_mpi;
    return PMPI_Recv(data, count, type, source, tag, comm, status);
}

int MPI_Irecv(void* data, int count, MPI_Datatype type, int source, int tag, MPI_Comm comm,
              MPI_Request* request) {
    const InMpi in_mpi;
    return PMPI_Irecv(data, count, type, source, tag, comm, request);
}

int MPI_Wait(MPI_Request* request, MPI_Status* status) {
    const InMpi in_mpi;
    return PMPI_Wait(request, status);
}

int MPI_Waitall(int count, MPI_Request requests[], MPI_Status statuses[]) {
    const InMpi in_mpi;
    return PMPI_Waitall(count, requests, statuses);
}

int MPI_Waitany(int count, MPI_Request requests[], int* index, MPI_Status* status) {
    const InMpi in_mpi;
    return PMPI_Waitany(count, requests, index, status);
}

int MPI_Waitsome(int count, MPI_Request requests[], int* num_done, int indices[],
                 MPI_Status statuses[]) {
    const InMpi in_mpi;
    return PMPI_Waitsome(count, requests, num_done, indices, statuses);
}

int MPI_Probe(int source, int tag, MPI_Comm comm, MPI_Status* status) {
    const InMpi in_mpi;
    return PMPI_Probe(source, tag, comm, status);
}

}  // extern "C"
