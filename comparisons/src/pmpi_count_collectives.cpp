#include "pmpi_count.hpp"

#include <numeric>

namespace {

using comparisons::bytes_of;
using comparisons::count_collective;
using comparisons::count_communicator;
using comparisons::counting_traffic;
using comparisons::InMpi;

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

}  // namespace

extern "C" {

int MPI_Barrier(MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) count_collective(__func__, 0, 0);
    return PMPI_Barrier(comm);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t bytes = bytes_of(count, type);
        const bool is_root = rank_in(comm) == root;
        count_collective(__func__, is_root ? bytes : 0, is_root ? 0 : bytes);
    }
    return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Reduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, int root,
               MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t bytes = bytes_of(count, type);
        count_collective(__func__, bytes, rank_in(comm) == root ? bytes : 0);
    }
    return PMPI_Reduce(data, result, count, type, op, root, comm);
}

int MPI_Allreduce(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic())
        count_collective(__func__, bytes_of(count, type), bytes_of(count, type));
    return PMPI_Allreduce(data, result, count, type, op, comm);
}

int MPI_Reduce_scatter(const void* data, void* result, const int counts[], MPI_Datatype type,
                       MPI_Op op, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        count_collective(__func__, bytes_of(sum(counts, comm), type),
                         bytes_of(counts[rank_in(comm)], type));
    }
    return PMPI_Reduce_scatter(data, result, counts, type, op, comm);
}

int MPI_Reduce_scatter_block(const void* data, void* result, int count, MPI_Datatype type,
                             MPI_Op op, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t out = bytes_of(count, type);
        count_collective(__func__, out * size_of(comm), out);
    }
    return PMPI_Reduce_scatter_block(data, result, count, type, op, comm);
}

int MPI_Scan(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op,
             MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic())
        count_collective(__func__, bytes_of(count, type), bytes_of(count, type));
    return PMPI_Scan(data, result, count, type, op, comm);
}

int MPI_Exscan(const void* data, void* result, int count, MPI_Datatype type, MPI_Op op,
               MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t bytes = bytes_of(count, type);
        count_collective(__func__, bytes, rank_in(comm) == 0 ? 0 : bytes);
    }
    return PMPI_Exscan(data, result, count, type, op, comm);
}

int MPI_Gather(const void* data, int count, MPI_Datatype type, void* gathered, int gathered_count,
               MPI_Datatype gathered_type, int root, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const bool is_root = rank_in(comm) == root;
        const std::int64_t out = is_root ? bytes_of(gathered_count, gathered_type) : 0;
        count_collective(__func__, data == MPI_IN_PLACE ? out : bytes_of(count, type),
                         out * size_of(comm));
    }
    return PMPI_Gather(data, count, type, gathered, gathered_count, gathered_type, root, comm);
}

int MPI_Gatherv(const void* data, int count, MPI_Datatype type, void* gathered, const int counts[],
                const int starts[], MPI_Datatype gathered_type, int root, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const bool is_root = rank_in(comm) == root;
        const std::int64_t in =
            data == MPI_IN_PLACE ? bytes_of(counts[root], gathered_type) : bytes_of(count, type);
        count_collective(__func__, in, is_root ? bytes_of(sum(counts, comm), gathered_type) : 0);
    }
    return PMPI_Gatherv(data, count, type, gathered, counts, starts, gathered_type, root, comm);
}

int MPI_Allgather(const void* data, int count, MPI_Datatype type, void* gathered,
                  int gathered_count, MPI_Datatype gathered_type, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t out = bytes_of(gathered_count, gathered_type);
        count_collective(__func__, data == MPI_IN_PLACE ? out : bytes_of(count, type),
                         out * size_of(comm));
    }
    return PMPI_Allgather(data, count, type, gathered, gathered_count, gathered_type, comm);
}

int MPI_Allgatherv(const void* data, int count, MPI_Datatype type, void* gathered,
                   const int counts[], const int starts[], MPI_Datatype gathered_type,
                   MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t in = data == MPI_IN_PLACE
                                    ? bytes_of(counts[rank_in(comm)], gathered_type)
                                    : bytes_of(count, type);
        count_collective(__func__, in, bytes_of(sum(counts, comm), gathered_type));
    }
    return PMPI_Allgatherv(data, count, type, gathered, counts, starts, gathered_type, comm);
}

int MPI_Scatter(const void* data, int count, MPI_Datatype type, void* received, int received_count,
                MPI_Datatype received_type, int root, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t in = rank_in(comm) == root ? bytes_of(count, type) : 0;
        count_collective(__func__, in * size_of(comm),
                         received == MPI_IN_PLACE ? in : bytes_of(received_count, received_type));
    }
    return PMPI_Scatter(data, count, type, received, received_count, received_type, root, comm);
}

int MPI_Scatterv(const void* data, const int counts[], const int starts[], MPI_Datatype type,
                 void* received, int received_count, MPI_Datatype received_type, int root,
                 MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t in = rank_in(comm) == root ? bytes_of(sum(counts, comm), type) : 0;
        count_collective(__func__, in,
                         received == MPI_IN_PLACE ? bytes_of(counts[root], type)
                                                  : bytes_of(received_count, received_type));
    }
    return PMPI_Scatterv(data, counts, starts, type, received, received_count, received_type, root,
                         comm);
}

int MPI_Alltoall(const void* data, int count, MPI_Datatype type, void* received, int received_count,
                 MPI_Datatype received_type, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t out = bytes_of(received_count, received_type) * size_of(comm);
        count_collective(__func__,
                         data == MPI_IN_PLACE ? out : bytes_of(count, type) * size_of(comm), out);
    }
    return PMPI_Alltoall(data, count, type, received, received_count, received_type, comm);
}

int MPI_Alltoallv(const void* data, const int counts[], const int starts[], MPI_Datatype type,
                  void* received, const int received_counts[], const int received_starts[],
                  MPI_Datatype received_type, MPI_Comm comm) {
    const InMpi in_mpi;
    if (counting_traffic()) {
        const std::int64_t out = bytes_of(sum(received_counts, comm), received_type);
        count_collective(__func__, data == MPI_IN_PLACE ? out : bytes_of(sum(counts, comm), type),
                         out);
    }
    return PMPI_Alltoallv(data, counts, starts, type, received, received_counts, received_starts,
                          received_type, comm);
}

int MPI_Comm_dup(MPI_Comm comm, MPI_Comm* made) {
    const InMpi in_mpi;
    count_communicator(__func__);
    return PMPI_Comm_dup(comm, made);
}

int MPI_Comm_split(MPI_Comm comm, int colour, int key, MPI_Comm* made) {
    const InMpi in_mpi;
    count_communicator(__func__);
    return PMPI_Comm_split(comm, colour, key, made);
}

int MPI_Comm_create(MPI_Comm comm, MPI_Group group, MPI_Comm* made) {
    const InMpi in_mpi;
    count_communicator(__func__);
    return PMPI_Comm_create(comm, group, made);
}

int MPI_Comm_free(MPI_Comm* comm) {
    const InMpi in_mpi;
    return PMPI_Comm_free(comm);
}

}  // extern "C"
