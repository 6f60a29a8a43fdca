// Measures the search for cuts with very many virtual ranks in one process, and prints a row of
// CSV.
#include "../../tests/support/virtual_search.hpp"

#include <mpi.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <string_view>

namespace {

using rrcb::test::Layout;

constexpr std::string_view layout_names[] = {"by_part", "by_row", "scattered"};

struct Arguments {
    int side = 0;
    Layout layout = Layout::by_part;
    double tolerance = 1;
    std::size_t points_per_rank = 8;
};

/// Returns false if the arguments are invalid.
bool read(int argc, char** argv, Arguments& arguments) {
    if (argc != 5) return false;
    const int ranks = std::atoi(argv[1]);
    for (arguments.side = 1; arguments.side * arguments.side < ranks;) arguments.side *= 2;
    const auto name = std::ranges::find(layout_names, std::string_view(argv[2]));
    arguments.layout = static_cast<Layout>(name - std::begin(layout_names));
    arguments.tolerance = std::atof(argv[3]);
    arguments.points_per_rank = static_cast<std::size_t>(std::atoi(argv[4]));
    return ranks == arguments.side * arguments.side && ranks > 64 &&
           name != std::end(layout_names) && arguments.tolerance >= 1 &&
           arguments.points_per_rank > 0;
}

void print_row(const Arguments& of) {
    const auto start = std::chrono::steady_clock::now();
    const rrcb::test::VirtualCloud cloud(of.side, of.points_per_rank, of.layout);
    rrcb::test::VirtualSearch ranks(cloud, of.tolerance);
    const rrcb::test::SearchTotals totals = ranks.search();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    std::cout << "ranks,layout,tolerance,points_per_rank,rounds,messages,bytes,bytes_in_a_row,"
                 "longest_message,most_into_rank,most_memory,imbalance,seconds\n"
              << cloud.num_ranks() << ',' << layout_names[static_cast<int>(of.layout)] << ','
              << of.tolerance << ',' << of.points_per_rank << ',' << totals.rounds << ','
              << totals.messages.messages << ',' << totals.messages.bytes << ','
              << totals.bytes_in_a_row << ',' << totals.longest() << ',' << totals.most_into_rank
              << ',' << totals.most_memory << ',' << ranks.imbalance() << ',' << time.count()
              << '\n';
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    if (!read(argc, argv, arguments)) {
        std::cerr << "rrcb_virtual_ranks RANKS by_part|by_row|scattered TOLERANCE POINTS_PER_RANK\n"
                     "RANKS must be a power of 4 above 64; TOLERANCE 1 asks for exact parts.\n";
        return 2;
    }
    MPI_Init(&argc, &argv);
    print_row(arguments);
    MPI_Finalize();
    return 0;
}
