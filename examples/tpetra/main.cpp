// Balances by the coordinates in a MultiVector of Tpetra, which an Import then redistributes.
#include <rrcb/experimental/kokkos.hpp>
#include <rrcb/transfer.hpp>

#include <Tpetra_Core.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_MultiVector.hpp>

#include <cstdio>
#include <span>

using Vectors = Tpetra::MultiVector<double>;
using Id = Vectors::global_ordinal_type;
using Map = Vectors::map_type;

// Creates the coordinates of a mesh that consists of rows of 1,000 nodes. Rank r has r + 1 rows.
Vectors coordinates_of(const Teuchos::RCP<const Teuchos::Comm<int>>& comm) {
    const int rank = comm->getRank();
    const auto map = Teuchos::rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                                          1000 * (rank + 1), 0, comm));
    Vectors coordinates(map, 2);
    for (int i = 0; i < 1000 * (rank + 1); ++i) {
        coordinates.replaceLocalValue(i, 0, i % 1000 / 1000.0);
        coordinates.replaceLocalValue(i, 1, rank + i / 1000 / (rank + 1.0));
    }
    return coordinates;
}

int main(int argc, char** argv) {
    const Tpetra::ScopeGuard scope(&argc, &argv);
    const auto comm = Tpetra::getDefaultComm();
    const Vectors before = coordinates_of(comm);
    const auto map = before.getMap();

    const auto x = before.getLocalViewDevice(Tpetra::Access::ReadOnly);
    const Vectors::execution_space exec;
    const auto balance = rrcb::experimental::balance(exec, x, MPI_COMM_WORLD);

    // Only the ids of the nodes are sent to the ranks of their parts. An Import moves the other
    // data.
    const auto parts = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), balance.parts);
    const rrcb::Plan plan = rrcb::plan(std::span<const rrcb::Part>(parts.data(), parts.size()),
                                       balance.cuts.num_parts, MPI_COMM_WORLD);
    const auto ids = map->getMyGlobalIndices();
    const std::vector<Id> here = rrcb::transfer(
        plan, rrcb::column(std::span<const Id>(ids.data(), parts.size())), MPI_COMM_WORLD);
    const auto target =
        Teuchos::rcp(new Map(map->getGlobalNumElements(), Teuchos::arrayViewFromVector(here),
                             map->getIndexBase(), comm));
    Vectors after(target, before.getNumVectors());
    after.doImport(before, Tpetra::Import<>(map, target), Tpetra::INSERT);

    const rrcb::Box box = rrcb::box_of(balance.cuts, comm->getRank());
    const auto y = after.getData(1);
    int inside = 0;
    for (const double value : y) inside += value >= box.lower[1] && value <= box.upper[1] ? 1 : 0;
    if (comm->getRank() == 0)
        std::printf("imbalance %.3f: rank 0 has %d nodes, %d in its box\n",
                    balance.report.imbalance, static_cast<int>(here.size()), inside);
}

// Output on 4 ranks:
// imbalance 1.000: rank 0 has 2500 nodes, 2500 in its box
