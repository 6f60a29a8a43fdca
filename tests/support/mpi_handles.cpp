#include "mpi_handles.hpp"

#include <mpi.h>

namespace {

rrcb::test::MpiHandles held;

int count_if_done(int code, int& number, int change) {
    if (code == MPI_SUCCESS) number += change;
    return code;
}

}  // namespace

namespace rrcb::test {

MpiHandles mpi_handles() {
    return held;
}

}  // namespace rrcb::test

extern "C" {

int MPI_Comm_dup(MPI_Comm comm, MPI_Comm* made) {
    return count_if_done(PMPI_Comm_dup(comm, made), held.communicators, 1);
}

int MPI_Comm_idup(MPI_Comm comm, MPI_Comm* made, MPI_Request* request) {
    return count_if_done(PMPI_Comm_idup(comm, made, request), held.communicators, 1);
}

int MPI_Comm_split(MPI_Comm comm, int color, int key, MPI_Comm* made) {
    return count_if_done(PMPI_Comm_split(comm, color, key, made), held.communicators, 1);
}

int MPI_Comm_create(MPI_Comm comm, MPI_Group group, MPI_Comm* made) {
    return count_if_done(PMPI_Comm_create(comm, group, made), held.communicators, 1);
}

int MPI_Comm_split_type(MPI_Comm comm, int type, int key, MPI_Info info, MPI_Comm* made) {
    return count_if_done(PMPI_Comm_split_type(comm, type, key, info, made), held.communicators, 1);
}

int MPI_Comm_free(MPI_Comm* comm) {
    return count_if_done(PMPI_Comm_free(comm), held.communicators, -1);
}

int MPI_Comm_create_keyval(MPI_Comm_copy_attr_function* copy, MPI_Comm_delete_attr_function* remove,
                           int* key, void* state) {
    return count_if_done(PMPI_Comm_create_keyval(copy, remove, key, state), held.attribute_keys, 1);
}

int MPI_Comm_free_keyval(int* key) {
    return count_if_done(PMPI_Comm_free_keyval(key), held.attribute_keys, -1);
}

int MPI_Type_contiguous(int count, MPI_Datatype element, MPI_Datatype* made) {
    return count_if_done(PMPI_Type_contiguous(count, element, made), held.datatypes, 1);
}

int MPI_Type_create_struct(int count, const int* lengths, const MPI_Aint* offsets,
                           const MPI_Datatype* types, MPI_Datatype* made) {
    return count_if_done(PMPI_Type_create_struct(count, lengths, offsets, types, made),
                         held.datatypes, 1);
}

int MPI_Type_free(MPI_Datatype* type) {
    return count_if_done(PMPI_Type_free(type), held.datatypes, -1);
}

int MPI_Op_create(MPI_User_function* function, int commutes, MPI_Op* made) {
    return count_if_done(PMPI_Op_create(function, commutes, made), held.operations, 1);
}

int MPI_Op_free(MPI_Op* operation) {
    return count_if_done(PMPI_Op_free(operation), held.operations, -1);
}

}  // extern "C"
