#include "collective/duplicate.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <rrcb/error.hpp>

#include <memory>

namespace rrcb::mpi {

namespace {

int free_duplicate(MPI_Comm, int, void* attribute, void*) {
    const std::unique_ptr<MPI_Comm> duplicate(static_cast<MPI_Comm*>(attribute));
    return MPI_Comm_free(duplicate.get());
}

int create_key() {
    int key = MPI_KEYVAL_INVALID;
    check(MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, free_duplicate, &key, nullptr),
          "MPI_Comm_create_keyval");
    return key;
}

int key() {
    static const int key = create_key();
    return key;
}

void refuse_two_groups(MPI_Comm user) {
    int has_two = 0;
    check(MPI_Comm_test_inter(user, &has_two), "MPI_Comm_test_inter");
    if (has_two != 0)
        throw Error(ErrorCode::invalid_argument,
                    "an intercommunicator has two groups; merge them by MPI_Intercomm_merge");
}

void keep(MPI_Comm duplicate, MPI_Comm user) {
    auto kept = std::make_unique<MPI_Comm>(duplicate);
    check(MPI_Comm_set_errhandler(duplicate, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    check(MPI_Comm_set_attr(user, key(), kept.get()), "MPI_Comm_set_attr");
    kept.release();
}

}  // namespace

const MPI_Comm* find_duplicate(MPI_Comm user) {
    void* attribute = nullptr;
    int found = 0;
    // A rank without a key has kept no duplicate, so no rank has one for a communicator that they
    // share.
    const Failure failure = attempt([] { key(); });
    if (failure.failed) return nullptr;
    check(MPI_Comm_get_attr(user, key(), &attribute, &found), "MPI_Comm_get_attr");
    return found != 0 ? static_cast<MPI_Comm*>(attribute) : nullptr;
}

MPI_Comm duplicate_of(MPI_Comm user) {
    if (user == MPI_COMM_NULL)
        throw Error(ErrorCode::invalid_argument,
                    "MPI_COMM_NULL has no ranks; give a communicator with this rank in it");
    if (const MPI_Comm* found = find_duplicate(user)) return *found;
    refuse_two_groups(user);
    MPI_Comm comm = MPI_COMM_NULL;
    Participant self{user};
    self.check(MPI_Comm_dup(user, &comm), "MPI_Comm_dup");
    self.attempt([&] { keep(comm, user); });
    try {
        agree(self);
    } catch (...) {
        if (!self.failed()) {
            MPI_Comm_delete_attr(user, key());
        } else if (comm != MPI_COMM_NULL) {
            MPI_Comm_free(&comm);
        }
        throw;
    }
    return comm;
}

}  // namespace rrcb::mpi
