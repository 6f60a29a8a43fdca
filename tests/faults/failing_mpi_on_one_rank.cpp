// failing_mpi_on_one_rank <number>: that call of MPI fails on the last rank, in the middle of a
// partition. Its rank learns of it and ends the program, as one does that checks codes.
#include "mpi_layer.hpp"
#include "program.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    rrcb::zoltan_test::Program program;
    rrcb::zoltan_test::scatter_points(program, 200);
    program.set("LB_METHOD", "RRCB");
    const bool is_last = program.rank == program.num_ranks - 1;
    mpi_layer::fail_call(is_last && argc > 1 ? std::atol(argv[1]) : 0);
    const int code = program.partition().code;
    if (code == ZOLTAN_FATAL) {
        std::fprintf(stderr, "rank %d: ZOLTAN_FATAL\n", program.rank);
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    Zoltan_Destroy(&program.zz);
    MPI_Finalize();
    return 0;
}
