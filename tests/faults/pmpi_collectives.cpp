#include "mpi_layer.hpp"

using mpi_layer::bytes_of;
using mpi_layer::call_of;
using mpi_layer::collective;

extern "C" {

int MPI_Barrier(MPI_Comm comm) {
    return collective(call_of("MPI_Barrier"), comm, [&] { return PMPI_Barrier(comm); });
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
    mpi_layer::note_message(bytes_of(count, type));
    return collective(call_of("MPI_Bcast", root, bytes_of(count, type)), comm,
                      [&] { return PMPI_Bcast(data, count, type, root, comm); });
}

int MPI_Reduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op operation, int root,
               MPI_Comm comm) {
    return collective(call_of("MPI_Reduce", root, bytes_of(count, type)), comm,
                      [&] { return PMPI_Reduce(in, out, count, type, operation, root, comm); });
}

int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op operation,
                  MPI_Comm comm) {
    return collective(call_of("MPI_Allreduce", -1, bytes_of(count, type)), comm,
                      [&] { return PMPI_Allreduce(in, out, count, type, operation, comm); });
}

int MPI_Scan(const void* in, void* out, int count, MPI_Datatype type, MPI_Op operation,
             MPI_Comm comm) {
    return collective(call_of("MPI_Scan", -1, bytes_of(count, type)), comm,
                      [&] { return PMPI_Scan(in, out, count, type, operation, comm); });
}

int MPI_Exscan(const void* in, void* out, int count, MPI_Datatype type, MPI_Op operation,
               MPI_Comm comm) {
    return collective(call_of("MPI_Exscan", -1, bytes_of(count, type)), comm,
                      [&] { return PMPI_Exscan(in, out, count, type, operation, comm); });
}

int MPI_Reduce_scatter(const void* in, void* out, const int counts[], MPI_Datatype type,
                       MPI_Op operation, MPI_Comm comm) {
    return collective(call_of("MPI_Reduce_scatter"), comm,
                      [&] { return PMPI_Reduce_scatter(in, out, counts, type, operation, comm); });
}

int MPI_Reduce_scatter_block(const void* in, void* out, int count, MPI_Datatype type,
                             MPI_Op operation, MPI_Comm comm) {
    return collective(call_of("MPI_Reduce_scatter_block", -1, bytes_of(count, type)), comm, [&] {
        return PMPI_Reduce_scatter_block(in, out, count, type, operation, comm);
    });
}

int MPI_Gather(const void* in, int num_in, MPI_Datatype type_in, void* out, int num_out,
               MPI_Datatype type_out, int root, MPI_Comm comm) {
    // The root may gather in place, without a length of its own.
    return collective(call_of("MPI_Gather", root), comm, [&] {
        return PMPI_Gather(in, num_in, type_in, out, num_out, type_out, root, comm);
    });
}

int MPI_Gatherv(const void* in, int num_in, MPI_Datatype type_in, void* out, const int nums_out[],
                const int starts[], MPI_Datatype type_out, int root, MPI_Comm comm) {
    return collective(call_of("MPI_Gatherv", root), comm, [&] {
        return PMPI_Gatherv(in, num_in, type_in, out, nums_out, starts, type_out, root, comm);
    });
}

int MPI_Scatter(const void* in, int num_in, MPI_Datatype type_in, void* out, int num_out,
                MPI_Datatype type_out, int root, MPI_Comm comm) {
    return collective(call_of("MPI_Scatter", root), comm, [&] {
        return PMPI_Scatter(in, num_in, type_in, out, num_out, type_out, root, comm);
    });
}

int MPI_Scatterv(const void* in, const int nums_in[], const int starts[], MPI_Datatype type_in,
                 void* out, int num_out, MPI_Datatype type_out, int root, MPI_Comm comm) {
    return collective(call_of("MPI_Scatterv", root), comm, [&] {
        return PMPI_Scatterv(in, nums_in, starts, type_in, out, num_out, type_out, root, comm);
    });
}

int MPI_Allgather(const void* in, int num_in, MPI_Datatype type_in, void* out, int num_out,
                  MPI_Datatype type_out, MPI_Comm comm) {
    return collective(call_of("MPI_Allgather", -1, bytes_of(num_out, type_out)), comm, [&] {
        return PMPI_Allgather(in, num_in, type_in, out, num_out, type_out, comm);
    });
}

int MPI_Allgatherv(const void* in, int num_in, MPI_Datatype type_in, void* out,
                   const int nums_out[], const int starts[], MPI_Datatype type_out, MPI_Comm comm) {
    return collective(call_of("MPI_Allgatherv"), comm, [&] {
        return PMPI_Allgatherv(in, num_in, type_in, out, nums_out, starts, type_out, comm);
    });
}

int MPI_Alltoall(const void* in, int num_in, MPI_Datatype type_in, void* out, int num_out,
                 MPI_Datatype type_out, MPI_Comm comm) {
    return collective(call_of("MPI_Alltoall", -1, bytes_of(num_out, type_out)), comm, [&] {
        return PMPI_Alltoall(in, num_in, type_in, out, num_out, type_out, comm);
    });
}

int MPI_Alltoallv(const void* in, const int nums_in[], const int starts_in[], MPI_Datatype type_in,
                  void* out, const int nums_out[], const int starts_out[], MPI_Datatype type_out,
                  MPI_Comm comm) {
    return collective(call_of("MPI_Alltoallv"), comm, [&] {
        return PMPI_Alltoallv(in, nums_in, starts_in, type_in, out, nums_out, starts_out, type_out,
                              comm);
    });
}

}  // extern "C"
