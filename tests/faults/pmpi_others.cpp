#include "mpi_layer.hpp"

using mpi_layer::call_of;
using mpi_layer::collective;
using mpi_layer::local_call;
using mpi_layer::message;

extern "C" {

int MPI_Init(int* num_arguments, char*** arguments) {
    const int code = PMPI_Init(num_arguments, arguments);
    mpi_layer::start_checking();
    return code;
}

int MPI_Init_thread(int* num_arguments, char*** arguments, int required, int* provided) {
    const int code = PMPI_Init_thread(num_arguments, arguments, required, provided);
    mpi_layer::start_checking();
    return code;
}

int MPI_Finalize(void) {
    mpi_layer::check_sequence(call_of("MPI_Finalize"), MPI_COMM_WORLD);
    mpi_layer::stop_checking();
    return PMPI_Finalize();
}

int MPI_Comm_dup(MPI_Comm comm, MPI_Comm* duplicate) {
    return collective(call_of("MPI_Comm_dup"), comm,
                      [&] { return PMPI_Comm_dup(comm, duplicate); });
}

int MPI_Comm_split(MPI_Comm comm, int color, int key, MPI_Comm* part) {
    return collective(call_of("MPI_Comm_split"), comm,
                      [&] { return PMPI_Comm_split(comm, color, key, part); });
}

int MPI_Comm_create(MPI_Comm comm, MPI_Group group, MPI_Comm* part) {
    return collective(call_of("MPI_Comm_create"), comm,
                      [&] { return PMPI_Comm_create(comm, group, part); });
}

int MPI_Comm_free(MPI_Comm* comm) {
    mpi_layer::check_sequence(call_of("MPI_Comm_free"), *comm);
    return PMPI_Comm_free(comm);
}

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
    mpi_layer::note_message(mpi_layer::bytes_of(count, type));
    return message(comm, [&] { return PMPI_Send(data, count, type, to, tag, comm); });
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
    mpi_layer::note_message(mpi_layer::bytes_of(count, type));
    return message(comm, [&] { return PMPI_Isend(data, count, type, to, tag, comm, request); });
}

int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
             MPI_Status* status) {
    return message(comm, [&] { return PMPI_Recv(data, count, type, from, tag, comm, status); });
}

int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request* request) {
    return message(comm, [&] { return PMPI_Irecv(data, count, type, from, tag, comm, request); });
}

int MPI_Probe(int from, int tag, MPI_Comm comm, MPI_Status* status) {
    return message(comm, [&] { return PMPI_Probe(from, tag, comm, status); });
}

int MPI_Type_contiguous(int count, MPI_Datatype element, MPI_Datatype* type) {
    return local_call([&] { return PMPI_Type_contiguous(count, element, type); });
}

int MPI_Type_commit(MPI_Datatype* type) {
    return local_call([&] { return PMPI_Type_commit(type); });
}

int MPI_Op_create(MPI_User_function* function, int commutes, MPI_Op* operation) {
    return local_call([&] { return PMPI_Op_create(function, commutes, operation); });
}

int MPI_Comm_set_errhandler(MPI_Comm comm, MPI_Errhandler handler) {
    return local_call([&] { return PMPI_Comm_set_errhandler(comm, handler); });
}

int MPI_Comm_set_attr(MPI_Comm comm, int key, void* value) {
    return local_call([&] { return PMPI_Comm_set_attr(comm, key, value); });
}

}  // extern "C"
