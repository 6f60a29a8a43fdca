// Counts the messages of the search for cuts on very many virtual ranks in one process, and prints
// a row of CSV. The points of each rank are in the part of the same number.
#include "../../tests/support/virtual_search.hpp"

#include <mpi.h>

#include <cstdlib>
#include <iostream>

namespace {

void print_row(int side, double tolerance) {
    constexpr std::size_t points_per_rank = 8;
    const rrcb::test::VirtualCloud cloud(side, points_per_rank, rrcb::test::Layout::by_part);
    const rrcb::test::SearchTotals totals = rrcb::test::VirtualSearch(cloud, tolerance).search();
    std::cout << "ranks,tolerance,rounds,messages,bytes,bytes_in_a_row,most_into_rank\n"
              << cloud.num_ranks() << ',' << tolerance << ',' << totals.rounds << ','
              << totals.messages.messages << ',' << totals.messages.bytes << ','
              << totals.bytes_in_a_row << ',' << totals.most_into_rank << '\n';
}

}  // namespace

int main(int argc, char** argv) {
    const int ranks = argc == 3 ? std::atoi(argv[1]) : 0;
    const double tolerance = argc == 3 ? std::atof(argv[2]) : 0;
    int side = 1;
    while (side * side < ranks) side *= 2;
    if (ranks != side * side || ranks <= 64 || tolerance < 1) {
        std::cerr << "rrcb_virtual_ranks RANKS TOLERANCE\n"
                     "RANKS must be a power of 4 above 64; TOLERANCE 1 asks for exact parts.\n";
        return 2;
    }
    MPI_Init(&argc, &argv);
    print_row(side, tolerance);
    MPI_Finalize();
    return 0;
}
