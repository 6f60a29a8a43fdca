#include "collective/machines_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/attribute_mpi.hpp"
#include "collective/communicator.hpp"

#include <array>
#include <memory>

namespace rrcb::mpi {

namespace {

/// Ranks of a machine, as kept with a communicator.
struct Kept {
    int number = 1;
};

/// What is kept with `comm`, or null. A rank without a key has kept none, so no rank has.
const Kept* find(MPI_Comm comm) {
    const Kept* kept = nullptr;
    attempt([&] { kept = Attribute<Kept>::find(comm); });
    return kept;
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
    if (const Kept* kept = find(self.comm)) return kept->number;
    const RanksHere ranks = ranks_here(self);
    int number = ranks.number;
    check(MPI_Bcast(&number, 1, MPI_INT, root, self.comm), "MPI_Bcast");
    Kept* kept = nullptr;
    self.attempt(
        [&] { kept = Attribute<Kept>::keep(std::make_unique<Kept>(Kept{number}), self.comm); });
    // The machines are alike if each rank lies where the size of the first one puts it.
    const bool fits = ranks.lowest == rank_of(self.comm) / number * number;
    const std::array shared{Shared{"machines", fits ? 0u : 1u}};
    try {
        if (find_difference(self, shared) == 0) kept->number = 1;
    } catch (...) {
        if (kept != nullptr) Attribute<Kept>::forget(self.comm);
        throw;
    }
    return kept->number;
}

}  // namespace rrcb::mpi
