#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <cstddef>
#include <span>
#include <vector>

// The calls of overhead.py in C++. Like there, a result is kept until the next one is made.

namespace {

rrcb::Balance balanced;
std::vector<double> moved;

}  // namespace

/// Balances (count, 3) doubles. Collective.
extern "C" __attribute__((visibility("default"))) void balance_points(MPI_Fint comm,
                                                                      const double* x,
                                                                      std::size_t count) {
    const rrcb::Points points({x, 3 * count}, 3);
    balanced = rrcb::balance(points, MPI_Comm_f2c(comm));
}

/// Moves the points of the last balance to the ranks of their parts. Collective.
extern "C" __attribute__((visibility("default"))) void move_points(MPI_Fint comm, const double* x,
                                                                   std::size_t count) {
    const MPI_Comm ranks = MPI_Comm_f2c(comm);
    const rrcb::Plan plan = rrcb::plan(balanced, ranks);
    moved = rrcb::transfer(plan, rrcb::column(std::span(x, 3 * count), 3), ranks);
}
