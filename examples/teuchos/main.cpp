// Balances with parameters from a file. Without a file it prints all parameters.
#include <rrcb/rrcb.hpp>
#include <rrcb/teuchos/parameters.hpp>

#include <mpi.h>

#include <cstdio>
#include <iostream>
#include <vector>

// Returns a square of 100 x 100 points. The squares of the ranks form a row.
std::vector<double> square_of(int rank) {
    std::vector<double> coordinates;
    for (int i = 0; i < 100; ++i) {
        for (int j = 0; j < 100; ++j) {
            coordinates.push_back(rank + (i + 0.5) / 100);
            coordinates.push_back((j + 0.5) / 100);
        }
    }
    return coordinates;
}

void balance_by(const char* file, int rank) {
    const rrcb::Options options = rrcb::teuchos::options_from(rrcb::teuchos::read_parameters(file));
    const std::vector<double> coordinates = square_of(rank);
    const rrcb::Points points(coordinates, 2);
    const rrcb::Balance balance = rrcb::balance(points, MPI_COMM_WORLD, options);
    if (rank != 0) return;
    std::printf("%lld points in %d parts, imbalance %.4f\n",
                static_cast<long long>(balance.report.details.num_points), balance.cuts.num_parts,
                balance.report.imbalance);
}

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    int code = 0;
    try {
        if (argc > 1) {
            balance_by(argv[1], rank);
        } else if (rank == 0) {
            rrcb::teuchos::valid_parameters()->print(
                std::cout, Teuchos::ParameterList::PrintOptions().showDoc(true).showTypes(true));
        }
    } catch (const rrcb::Error& error) {
        if (rank == 0) std::fprintf(stderr, "%s\n", error.what());
        code = 1;
    }
    MPI_Finalize();
    return code;
}

// Output on 4 ranks with parameters.yaml:
// 40000 points in 8 parts, imbalance 1.0000
