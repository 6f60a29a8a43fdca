// Between rebalances a step makes no blocking collective call, and one reduction that overlaps with
// the next step. This file stands between the program and MPI.
#include "support.hpp"

#include <gtest/gtest.h>

namespace {

int num_blocking = 0;
int num_overlapping = 0;

}  // namespace

extern "C" {

int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
    ++num_blocking;
    return PMPI_Allreduce(in, out, count, type, op, comm);
}

int MPI_Bcast(void* data, int count, MPI_Datatype type, int root, MPI_Comm comm) {
    ++num_blocking;
    return PMPI_Bcast(data, count, type, root, comm);
}

int MPI_Barrier(MPI_Comm comm) {
    ++num_blocking;
    return PMPI_Barrier(comm);
}

int MPI_Alltoall(const void* in, int in_count, MPI_Datatype in_type, void* out, int out_count,
                 MPI_Datatype out_type, MPI_Comm comm) {
    ++num_blocking;
    return PMPI_Alltoall(in, in_count, in_type, out, out_count, out_type, comm);
}

int MPI_Iallreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                   MPI_Comm comm, MPI_Request* request) {
    ++num_overlapping;
    return PMPI_Iallreduce(in, out, count, type, op, comm, request);
}

}  // extern "C"

namespace mpm::test {
namespace {

TEST(Calls, of_a_step_block_no_rank) {
    Simulation simulation(flying_disk(), MPI_COMM_WORLD);
    const Balancer halves = [](Positions, MPI_Comm comm) {
        return slabs({{3, 2, 0}, {6, 6, 0}}, size_of(comm));
    };
    for (int cycle = 0; cycle < 2; ++cycle) {
        simulation.rebalance(halves);
        const std::int64_t num_before = simulation.totals().num_migrated;
        EXPECT_GT(num_blocking, 0) << "totals() is counted";
        num_blocking = num_overlapping = 0;
        for (int step = 0; step < 40; ++step) simulation.step();
        EXPECT_EQ(num_blocking, 0);
        EXPECT_EQ(num_overlapping, 40);
        if (size_of(MPI_COMM_WORLD) > 1) {
            EXPECT_GT(simulation.totals().num_migrated, num_before);
        }
    }
}

}  // namespace
}  // namespace mpm::test
