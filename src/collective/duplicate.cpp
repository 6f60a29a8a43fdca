#include "collective/duplicate.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <rrcb/error.hpp>

#include <memory>
#include <utility>

namespace rrcb::mpi {

namespace {

int free_duplicate(MPI_Comm, int, void* attribute, void*) {
    const std::unique_ptr<Duplicate> duplicate(static_cast<Duplicate*>(attribute));
    return MPI_Comm_free(&duplicate->comm);
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

/// Duplicate kept with `user`, or null. A rank without a key has kept none, so no rank has for a
/// communicator that they share.
Duplicate* find(MPI_Comm user) {
    void* attribute = nullptr;
    int found = 0;
    const Failure failure = attempt([] { key(); });
    if (failure.failed) return nullptr;
    check(MPI_Comm_get_attr(user, key(), &attribute, &found), "MPI_Comm_get_attr");
    return found != 0 ? static_cast<Duplicate*>(attribute) : nullptr;
}

void refuse_two_groups(MPI_Comm user) {
    int has_two = 0;
    check(MPI_Comm_test_inter(user, &has_two), "MPI_Comm_test_inter");
    if (has_two != 0)
        throw Error(ErrorCode::invalid_argument,
                    "an intercommunicator has two groups; merge them by MPI_Intercomm_merge");
}

void keep(std::unique_ptr<Duplicate>& duplicate, MPI_Comm user) {
    check(MPI_Comm_set_errhandler(duplicate->comm, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
    const int num_ranks = size_of(user);
    if (num_ranks <= most_ranks_at_once)
        duplicate->per_rank.resize(static_cast<std::size_t>(num_ranks));
    check(MPI_Comm_set_attr(user, key(), duplicate.get()), "MPI_Comm_set_attr");
    duplicate.release();
}

}  // namespace

Duplicate& duplicate_with(MPI_Comm user) {
    if (user == MPI_COMM_NULL)
        throw Error(ErrorCode::invalid_argument,
                    "MPI_COMM_NULL has no ranks; give a communicator with this rank in it");
    if (Duplicate* found = find(user)) return *found;
    refuse_two_groups(user);
    MPI_Comm comm = MPI_COMM_NULL;
    std::unique_ptr<Duplicate> duplicate;
    Participant self{user};
    self.check(MPI_Comm_dup(user, &comm), "MPI_Comm_dup");
    self.attempt([&] {
        duplicate = std::make_unique<Duplicate>();
        duplicate->comm = comm;
        keep(duplicate, user);
    });
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
    return *find(user);
}

std::span<std::int64_t> per_rank_of(Duplicate& kept) {
    if (!kept.per_rank.empty()) return kept.per_rank;
    std::vector<std::int64_t> made;
    Participant self{kept.comm};
    self.attempt([&] { made.resize(static_cast<std::size_t>(size_of(kept.comm))); });
    agree(self);
    kept.per_rank = std::move(made);
    return kept.per_rank;
}

}  // namespace rrcb::mpi
