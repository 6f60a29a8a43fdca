#pragma once

#include <mpi.h>

// Counts the communicators that are alive in this process. One file of a program includes it.
static int num_communicators = 0;

extern "C" int MPI_Comm_dup(MPI_Comm comm, MPI_Comm* copy) {
    ++num_communicators;
    return PMPI_Comm_dup(comm, copy);
}

extern "C" int MPI_Comm_idup(MPI_Comm comm, MPI_Comm* copy, MPI_Request* request) {
    ++num_communicators;
    return PMPI_Comm_idup(comm, copy, request);
}

extern "C" int MPI_Comm_split(MPI_Comm comm, int color, int key, MPI_Comm* part) {
    ++num_communicators;
    return PMPI_Comm_split(comm, color, key, part);
}

extern "C" int MPI_Comm_split_type(MPI_Comm comm, int type, int key, MPI_Info info,
                                   MPI_Comm* part) {
    ++num_communicators;
    return PMPI_Comm_split_type(comm, type, key, info, part);
}

extern "C" int MPI_Comm_free(MPI_Comm* comm) {
    --num_communicators;
    return PMPI_Comm_free(comm);
}
