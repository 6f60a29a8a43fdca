// Stands for LAMMPS in the test of examples/lammps: a library with a class RCB of the same layout,
// made as there by inheritance, that bisects all points on every rank.
#include "lammps_original.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

namespace LAMMPS_NS {

RCB::RCB(MPI_Comm& comm) : Pointers(comm) {
    MPI_Comm_rank(world, &me);
    MPI_Comm_size(world, &nprocs);
}

RCB::~RCB() {
    std::free(sendproc);
    std::free(sendindex);
}

void RCB::compute(int dimension, int n, double** x, double*, double* lower, double* upper) {
    std::vector<int> counts(nprocs), starts(nprocs);
    const int size = 3 * n;
    MPI_Allgather(&size, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
    const int total = (starts.back() + counts.back()) / 3;
    std::vector<double> all(3 * total);
    MPI_Allgatherv(n > 0 ? x[0] : nullptr, size, MPI_DOUBLE, all.data(), counts.data(),
                   starts.data(), MPI_DOUBLE, world);
    std::vector<int> order(total);
    std::iota(order.begin(), order.end(), 0);
    lo = std::copy(lower, lower + 3, bbox.lo) - 3;
    hi = std::copy(upper, upper + 3, bbox.hi) - 3;
    cut = 0;
    cutdim = -1;
    auto begin = order.begin(), end = order.end();
    for (int first = 0, last = nprocs - 1; first < last;) {
        int axis = 0;
        for (int a = 1; a < dimension; ++a)
            if (hi[a] - lo[a] > hi[axis] - lo[axis]) axis = a;
        const int middle = first + (last - first) / 2 + 1;
        const auto half = begin + (end - begin) * (middle - first) / (last - first + 1);
        std::sort(begin, end, [&](int i, int j) { return all[3 * i + axis] < all[3 * j + axis]; });
        const double at = (all[3 * half[-1] + axis] + all[3 * *half + axis]) / 2;
        if (me == middle) cut = at, cutdim = axis;
        (me < middle ? hi : lo)[axis] = at;
        (me < middle ? last : first) = me < middle ? middle - 1 : middle;
        (me < middle ? end : begin) = half;
    }
    owners.assign(total, 0);
    for (auto i = begin; i != end; ++i) owners[*i] = me;
    MPI_Allreduce(MPI_IN_PLACE, owners.data(), total, MPI_INT, MPI_SUM, world);
    first_owner = starts[me] / 3;
    nfinal = static_cast<int>(end - begin);
    noriginal = n;
}

void RCB::invert(int) {
    if (noriginal > maxsend) {
        std::free(sendproc);
        std::free(sendindex);
        maxsend = noriginal;
        sendproc = static_cast<int*>(std::calloc(maxsend, sizeof(int)));
        sendindex = static_cast<int*>(std::calloc(maxsend, sizeof(int)));
    }
    std::copy_n(owners.begin() + first_owner, noriginal, sendproc);
}

}  // namespace LAMMPS_NS
