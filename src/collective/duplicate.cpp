#include "collective/duplicate.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/attribute_mpi.hpp"
#include "collective/communicator.hpp"

#include <rrcb/error.hpp>

#include <memory>

namespace rrcb::mpi {

namespace {

/// Freed with the communicator that it is kept with.
struct Duplicate {
    MPI_Comm comm = MPI_COMM_NULL;

    ~Duplicate() {
        if (comm != MPI_COMM_NULL) MPI_Comm_free(&comm);
    }
};

void refuse_two_groups(MPI_Comm user) {
    int has_two = 0;
    check(MPI_Comm_test_inter(user, &has_two), "MPI_Comm_test_inter");
    if (has_two != 0)
        throw Error(ErrorCode::invalid_argument,
                    "an intercommunicator has two groups; merge them by MPI_Intercomm_merge");
}

}  // namespace

const MPI_Comm* find_duplicate(MPI_Comm user) {
    const Duplicate* found = Attribute<Duplicate>::find(user);
    return found != nullptr ? &found->comm : nullptr;
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
    self.attempt([&] {
        check(MPI_Comm_set_errhandler(comm, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
        Attribute<Duplicate>::keep(std::make_unique<Duplicate>(), user)->comm = comm;
    });
    try {
        agree(self);
    } catch (...) {
        if (!self.failed()) {
            Attribute<Duplicate>::forget(user);
        } else if (comm != MPI_COMM_NULL) {
            MPI_Comm_free(&comm);
        }
        throw;
    }
    return comm;
}

}  // namespace rrcb::mpi
