// Two threads that balance points in views at the same time, each on its own communicator.
#include <rrcb/experimental/kokkos.hpp>

#include <mpi.h>

#include <array>
#include <cstdio>
#include <thread>

namespace {

using Device = Kokkos::DefaultHostExecutionSpace;
using Positions = Kokkos::View<double* [3], Device>;

/// Returns points whose coordinates are Weyl sequences, other ones for each thread and rank.
Positions points_of(int rank, int thread) {
    const Positions x("x", 20000);
    for (int i = 0; i < 20000; ++i)
        for (int a = 0; a < 3; ++a) {
            const double u = (i + 1) * (0.8191725 - 0.148 * a + 0.01 * rank + 0.003 * thread);
            x(i, a) = u - static_cast<int>(u);
        }
    return x;
}

/// Returns the number of points in each part, by the parts of the points and by the report.
std::array<double, 10> counts_of(const Positions& x, MPI_Comm comm) {
    const rrcb::Options options{.num_parts = 5};
    const auto balance = rrcb::experimental::balance(Device(), x, comm, options);
    std::array<double, 10> counts{};
    for (std::size_t i = 0; i < balance.parts.extent(0); ++i) counts[balance.parts(i)] += 1;
    for (std::size_t p = 0; p < 5; ++p) counts[5 + p] = balance.report.part_weights[p];
    return counts;
}

/// Returns the number of calls whose counts differ from those of a call without other threads.
int num_wrong_calls() {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    std::array<int, 2> wrong{};
    std::array<MPI_Comm, 2> comms{};
    std::array<std::thread, 2> threads;
    std::array<Positions, 2> x;
    std::array<std::array<double, 10>, 2> expected;
    for (int t = 0; t < 2; ++t) {
        MPI_Comm_dup(MPI_COMM_WORLD, &comms[t]);
        x[t] = points_of(rank, t);
        expected[t] = counts_of(x[t], comms[t]);
    }
    for (int t = 0; t < 2; ++t)
        threads[t] = std::thread([&, t] {
            for (int k = 0; k < 20; ++k) wrong[t] += counts_of(x[t], comms[t]) != expected[t];
        });
    for (std::thread& thread : threads) thread.join();
    for (MPI_Comm& comm : comms) MPI_Comm_free(&comm);
    return wrong[0] + wrong[1];
}

}  // namespace

int main(int argc, char** argv) {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &provided);
    Kokkos::initialize(argc, argv);
    int wrong = provided == MPI_THREAD_MULTIPLE ? num_wrong_calls() : 0;
    if (provided != MPI_THREAD_MULTIPLE) std::printf("skipped: no MPI_THREAD_MULTIPLE\n");
    MPI_Allreduce(MPI_IN_PLACE, &wrong, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    if (wrong > 0) std::printf("%d calls are wrong\n", wrong);
    Kokkos::finalize();
    MPI_Finalize();
    return provided != MPI_THREAD_MULTIPLE ? 77 : wrong > 0;
}
