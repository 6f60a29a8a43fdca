#include "search/workspace_mpi.hpp"

#include "collective/communicator.hpp"
#include "collective/duplicate.hpp"

#include <rrcb/balance.hpp>
#include <rrcb/error.hpp>

#include <memory>

namespace rrcb {

namespace {

int free_workspace(MPI_Comm, int, void* attribute, void*) {
    delete static_cast<Workspace*>(attribute);
    return MPI_SUCCESS;
}

int create_key() {
    int key = MPI_KEYVAL_INVALID;
    mpi::check(MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, free_workspace, &key, nullptr),
               "MPI_Comm_create_keyval");
    return key;
}

int key() {
    static const int key = create_key();
    return key;
}

Workspace* find(MPI_Comm duplicate) {
    void* attribute = nullptr;
    int found = 0;
    mpi::check(MPI_Comm_get_attr(duplicate, key(), &attribute, &found), "MPI_Comm_get_attr");
    return found != 0 ? static_cast<Workspace*>(attribute) : nullptr;
}

}  // namespace

Workspace& workspace_of(MPI_Comm duplicate) {
    if (Workspace* found = find(duplicate)) return *found;
    auto made = std::make_unique<Workspace>();
    mpi::check(MPI_Comm_set_attr(duplicate, key(), made.get()), "MPI_Comm_set_attr");
    return *made.release();
}

void release_buffers(MPI_Comm comm) {
    if (comm == MPI_COMM_NULL)
        throw Error(ErrorCode::invalid_argument, "MPI_COMM_NULL keeps no buffers");
    const MPI_Comm* duplicate = mpi::find_duplicate(comm);
    if (duplicate != nullptr && find(*duplicate) != nullptr)
        mpi::check(MPI_Comm_delete_attr(*duplicate, key()), "MPI_Comm_delete_attr");
}

}  // namespace rrcb
