#pragma once

#include <mpi.h>

namespace LAMMPS_NS {

/// The layout in memory of LAMMPS' class RCB (see its src/rcb.h and src/pointers.h), with the two
/// functions that librrcb_lammps defines in place of LAMMPS.
class RCB {
  public:
    void compute(int dimension, int n, double** x, double* weights, double* lower, double* upper);
    void invert(int sort);

    // The base class.
    void* vtable;
    void* classes[15];
    MPI_Comm* world;
    void* others[6];

    int noriginal, nfinal, nkeep;
    int *recvproc, *recvindex;
    double *lo, *hi;  // bounds of this rank's box; they point into `box`
    double cut;       // position of the cut whose upper side begins with this rank
    int cutdim;       // axis of that cut; -1 on rank 0
    int *sendproc, *sendindex;

    int me, nprocs;
    void* dots;
    int ndot, maxdot, ndotorig, nlist, maxlist;
    int *dotlist, *dotmark, *dotmark_select;
    int maxbuf;
    void* buf;
    int maxrecv, maxsend;  // lengths of the arrays
    struct {
        double lo[3], hi[3];
    } box;
};

}  // namespace LAMMPS_NS
