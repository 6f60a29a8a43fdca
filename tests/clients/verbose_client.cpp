// verbose_client <value of RETURN_LISTS>...: a partition for each, of 300 objects per rank that all
// are on rank 0. All but those of rank 0 move.
#include "program.hpp"

using rrcb::zoltan_test::Program;

namespace {

bool balances(const char* lists) {
    Program program(1);
    const int count = program.rank == 0 ? 300 * program.num_ranks : 0;
    for (int i = 0; i < count; ++i) program.add({1.0 * i});
    program.set("LB_METHOD", "RRCB");
    program.set("RRCB_REFINE", "EXACT");
    program.set("RETURN_LISTS", lists);
    return program.partition().code == ZOLTAN_OK;
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    bool all_balance = true;
    for (int i = 1; i < argc; ++i) all_balance = balances(argv[i]) && all_balance;
    MPI_Finalize();
    return all_balance ? 0 : 1;
}
