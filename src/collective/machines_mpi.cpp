#include "collective/machines_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/communicator.hpp"

#include <array>
#include <memory>

namespace rrcb::mpi {

namespace {

int free_number(MPI_Comm, int, void* number, void*) {
    delete static_cast<int*>(number);
    return MPI_SUCCESS;
}

int create_key() {
    int key = MPI_KEYVAL_INVALID;
    check(MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, free_number, &key, nullptr),
          "MPI_Comm_create_keyval");
    return key;
}

int key() {
    static const int key = create_key();
    return key;
}

/// Number kept with `comm`, or null. A rank without a key has kept none, so no rank has.
const int* find(MPI_Comm comm) {
    if (attempt([] { key(); }).failed) return nullptr;
    void* number = nullptr;
    int found = 0;
    check(MPI_Comm_get_attr(comm, key(), &number, &found), "MPI_Comm_get_attr");
    return found != 0 ? static_cast<int*>(number) : nullptr;
}

int* keep(int number, MPI_Comm comm) {
    auto kept = std::make_unique<int>(number);
    check(MPI_Comm_set_attr(comm, key(), kept.get()), "MPI_Comm_set_attr");
    return kept.release();
}

/// Ranks on the machine of this one.
struct RanksHere {
    int lowest = 0;
    int number = 1;
};

/// Collective.
RanksHere ranks_here(Participant& self) {
    RanksHere ranks{rank_of(self.comm)};
    MPI_Comm machine = MPI_COMM_NULL;
    self.check(MPI_Comm_split_type(self.comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine),
               "MPI_Comm_split_type");
    if (machine == MPI_COMM_NULL) return ranks;
    self.check(MPI_Comm_size(machine, &ranks.number), "MPI_Comm_size");
    // Ranks are ordered as in `comm`, so that the first is the lowest.
    self.check(MPI_Bcast(&ranks.lowest, 1, MPI_INT, 0, machine), "MPI_Bcast");
    self.check(MPI_Comm_free(&machine), "MPI_Comm_free");
    return ranks;
}

}  // namespace

int ranks_per_machine(Participant& self) {
    if (const int* kept = find(self.comm)) return *kept;
    const RanksHere ranks = ranks_here(self);
    int number = ranks.number;
    check(MPI_Bcast(&number, 1, MPI_INT, root, self.comm), "MPI_Bcast");
    int* kept = nullptr;
    self.attempt([&] { kept = keep(number, self.comm); });
    // The machines are alike if each rank lies where the size of the first one puts it.
    const bool fits = ranks.lowest == rank_of(self.comm) / number * number;
    const std::array shared{Shared{"machines", fits ? 0u : 1u}};
    try {
        if (find_difference(self, shared) == 0) *kept = 1;
    } catch (...) {
        if (kept != nullptr) MPI_Comm_delete_attr(self.comm, key());
        throw;
    }
    return *kept;
}

}  // namespace rrcb::mpi
