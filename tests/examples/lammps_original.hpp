#pragma once

#include <mpi.h>

#include <vector>

namespace LAMMPS_NS {

/// References to 22 objects of LAMMPS, of which only the communicator is used.
class Pointers {
  public:
    explicit Pointers(MPI_Comm& comm) : world(comm) {}
    virtual ~Pointers() = default;

  protected:
    void* before[15] = {};
    MPI_Comm& world;
    void* after[6] = {};
};

/// The public part of LAMMPS' class, and private members up to the last that the shim reads.
class RCB : protected Pointers {
  public:
    explicit RCB(MPI_Comm& comm);
    ~RCB() override;
    void compute(int dimension, int n, double** x, double* weights, double* lower, double* upper);
    void invert(int sort = 0);

#ifdef OTHER_LAYOUT
    double one_more = 0;
#endif
    int noriginal = 0, nfinal = 0, nkeep = 0;
    int *recvproc = nullptr, *recvindex = nullptr;
    double *lo = nullptr, *hi = nullptr;
    double cut = 0;
    int cutdim = -1;
    int *sendproc = nullptr, *sendindex = nullptr;

  protected:  // private in LAMMPS; Clang reports private fields without a use
    int me = 0, nprocs = 1;
    void* dots = nullptr;
    int ndot = 0, maxdot = 0, ndotorig = 0, nlist = 0, maxlist = 0;
    int *dotlist = nullptr, *dotmark = nullptr, *dotmark_select = nullptr;
    int maxbuf = 0;
    void* buf = nullptr;
    int maxrecv = 0, maxsend = 0;
    struct BBox {
        double lo[3], hi[3];
    } bbox{};
    std::vector<int> owners;
    int first_owner = 0;
};

}  // namespace LAMMPS_NS
