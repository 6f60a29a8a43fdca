// Balances positions that are in the memory of a device, sends them to the ranks of their parts,
// and fetches the points that are near the box of each rank.
#include <rrcb/experimental/kokkos.hpp>
#include <rrcb/ghosts.hpp>
#include <rrcb/points.hpp>
#include <rrcb/transfer.hpp>

#include <Kokkos_Sort.hpp>

#include <cstdio>
#include <numeric>

using Positions = Kokkos::View<double* [2], Kokkos::LayoutRight>;
using Ranks = Kokkos::View<int*>;
using ByRank = Kokkos::BinOp1D<Ranks>;

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    Kokkos::initialize(argc, argv);
    {
        int rank = 0, num_ranks = 0;
        MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
        const Positions x("x", 4000 * (rank + 1));
        Kokkos::parallel_for(
            x.extent(0), KOKKOS_LAMBDA(const int i) {
                x(i, 0) = rank + (i % 40 + 0.5) / 40;
                x(i, 1) = (i / 40 + 0.5) / 100;
            });

        const Kokkos::DefaultExecutionSpace exec;
        const auto balance = rrcb::experimental::balance(exec, x, MPI_COMM_WORLD);
        const Ranks ranks = rrcb::experimental::destinations(exec, balance, rank, num_ranks);
        // The positions are packed by rank on the device, and exchanged in the memory of the host.
        Kokkos::BinSort<Ranks, ByRank> by_rank(ranks, ByRank(num_ranks, 0, num_ranks));
        by_rank.create_permute_vector();
        const Positions sorted("sorted", x.extent(0));
        const auto order = by_rank.get_permute_vector();
        Kokkos::parallel_for(
            x.extent(0), KOKKOS_LAMBDA(const int i) {
                for (int a = 0; a < 2; ++a) sorted(i, a) = x(order(i), a);
            });
        const auto leaving = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sorted);
        const auto counts =
            Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), by_rank.get_bin_count());
        std::vector<int> sent(num_ranks), starts(num_ranks + 1), got(num_ranks),
            ends(num_ranks + 1);
        for (int to = 0; to < num_ranks; ++to) sent[to] = 2 * counts(to);
        MPI_Alltoall(sent.data(), 1, MPI_INT, got.data(), 1, MPI_INT, MPI_COMM_WORLD);
        std::partial_sum(sent.begin(), sent.end(), starts.begin() + 1);
        std::partial_sum(got.begin(), got.end(), ends.begin() + 1);
        const Positions::HostMirror here("here", ends.back() / 2);
        MPI_Alltoallv(leaving.data(), sent.data(), starts.data(), MPI_DOUBLE, here.data(),
                      got.data(), ends.data(), MPI_DOUBLE, MPI_COMM_WORLD);

        // Sends each point to the ranks whose boxes are near it. Reads the host's copy of the
        // positions.
        const rrcb::GhostPlan near =
            rrcb::ghost_plan(balance.cuts, rrcb::Points(here), MPI_COMM_WORLD, {.cutoff = 0.02});
        const std::span values(here.data(), here.span());
        const auto ghosts = rrcb::fetch(near, rrcb::column(values, 2), MPI_COMM_WORLD);
        if (rank == 0)
            std::printf("imbalance %.3f, %d points and %zu ghosts\n", balance.report.imbalance,
                        static_cast<int>(here.extent(0)), ghosts.size() / 2);
    }
    Kokkos::finalize();
    MPI_Finalize();
}

// Output on 4 ranks:
// imbalance 1.010, 10000 points and 200 ghosts
