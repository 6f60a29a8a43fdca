#include "collective/machines_mpi.hpp"

#include "collective/agreement_mpi.hpp"
#include "collective/attribute_mpi.hpp"
#include "collective/communicator.hpp"

#include <algorithm>
#include <array>
#include <memory>

namespace rrcb::mpi {

namespace {

/// Returns the machines kept with `comm`, or null.
const Machines* find(MPI_Comm comm) {
    const Machines* kept = nullptr;
    attempt([&] { kept = Attribute<Machines>::find(comm); });
    return kept;
}

/// The machine of this rank.
struct MachineHere {
    int num_ranks = 1;
    std::array<int, 2> lowest{};  ///< the two lowest ranks on it; equal if it has only one rank
};

/// Finds the machine of this rank. Collective.
MachineHere machine_here(Participant& self) {
    MachineHere here{1, {rank_of(self.comm), rank_of(self.comm)}};
    MPI_Comm machine = MPI_COMM_NULL;
    self.check(MPI_Comm_split_type(self.comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine),
               "MPI_Comm_split_type");
    if (machine == MPI_COMM_NULL) return here;
    self.check(MPI_Comm_size(machine, &here.num_ranks), "MPI_Comm_size");
    MPI_Group of_machine = MPI_GROUP_NULL;
    MPI_Group all = MPI_GROUP_NULL;
    self.check(MPI_Comm_group(machine, &of_machine), "MPI_Comm_group");
    self.check(MPI_Comm_group(self.comm, &all), "MPI_Comm_group");
    // Ranks of `of_machine` are ordered as in `comm`, so the first two are the lowest.
    const std::array first{0, std::min(1, here.num_ranks - 1)};
    self.check(MPI_Group_translate_ranks(of_machine, 2, first.data(), all, here.lowest.data()),
               "MPI_Group_translate_ranks");
    self.check(MPI_Group_free(&of_machine), "MPI_Group_free");
    self.check(MPI_Group_free(&all), "MPI_Group_free");
    self.check(MPI_Comm_free(&machine), "MPI_Comm_free");
    return here;
}

}  // namespace

Machines machines_of(Participant& self) {
    if (const Machines* known = find(self.comm)) return *known;
    // Creating a communicator blocks unless all ranks take part.
    if (self.is_meeting()) agree(self);
    const MachineHere here = machine_here(self);
    // Number of ranks of the first machine, and distance between its two lowest ranks.
    std::array first{here.num_ranks, here.lowest[1] - here.lowest[0]};
    check(MPI_Bcast(first.data(), 2, MPI_INT, root, self.comm), "MPI_Bcast");
    const auto [num_ranks, distance] = first;
    const int rank = rank_of(self.comm);
    Machines made{num_ranks, distance > 1};
    // Machines are alike if the lowest rank of each is the one that the first machine predicts.
    const int lowest = made.dealt ? rank % distance : rank / num_ranks * num_ranks;
    // If ranks are dealt in turn, only the last machine may have fewer ranks than the others.
    const bool ends_well = !made.dealt || (size_of(self.comm) + 1) % distance <= 1;
    // Rank 0 always fits, so the values of the ranks differ if any machine does not fit.
    const bool fits = here.lowest[0] == lowest && (rank == root || ends_well);
    std::array shared{Shared{"machines", fits ? 0u : 1u}};
    Machines* kept = nullptr;
    self.attempt(
        [&] { kept = Attribute<Machines>::keep(std::make_unique<Machines>(made), self.comm); });
    try {
        if (find_difference(self, shared) == 0) made = *kept = Machines{};
    } catch (...) {
        if (kept != nullptr) Attribute<Machines>::forget(self.comm);
        throw;
    }
    return made;
}

}  // namespace rrcb::mpi
