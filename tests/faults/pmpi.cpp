#include "mpi_layer.hpp"

using mpi_layer::bytes_of;
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

int MPI_Comm_free(MPI_Comm* comm) {
    mpi_layer::check_sequence(call_of("MPI_Comm_free"), *comm);
    return PMPI_Comm_free(comm);
}

#define CALL(name, arguments) [&] { return PMPI_##name arguments; }
#define COLLECTIVE(name, parameters, arguments, root, same, in, out)                       \
    int MPI_##name parameters {                                                            \
        return collective(call_of("MPI_" #name, root, same), comm, CALL(name, arguments)); \
    }
#define BROADCAST(name, parameters, arguments, root, same, in, out)                        \
    int MPI_##name parameters {                                                            \
        mpi_layer::note_message(same);                                                     \
        return collective(call_of("MPI_" #name, root, same), comm, CALL(name, arguments)); \
    }
#define COMMUNICATOR(name, parameters, arguments) \
    COLLECTIVE(name, parameters, arguments, -1, 0, 0, 0)
#define SEND(name, parameters, arguments)               \
    int MPI_##name parameters {                         \
        mpi_layer::note_message(bytes_of(count, type)); \
        return message(comm, CALL(name, arguments));    \
    }
#define RECEIVE(name, parameters, arguments)         \
    int MPI_##name parameters {                      \
        return message(comm, CALL(name, arguments)); \
    }
#include "../../comparisons/driver/mpi_functions.inc"

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
