// Linked with an example in C or Fortran: more than two ranks make the parts together. The linker
// sends calls of rrcb_balancer_create here.
#include <rrcb/rrcb.h>

int __real_rrcb_balancer_create(MPI_Comm comm, rrcb_balancer** balancer);
int __real_rrcb_balancer_create_fortran(MPI_Fint comm, rrcb_balancer** balancer);

static int for_many_ranks(int code, rrcb_balancer* balancer) {
    if (code == RRCB_OK) code = rrcb_balancer_set(balancer, "max_root_parts", "2");
    return code;
}

int __wrap_rrcb_balancer_create(MPI_Comm comm, rrcb_balancer** balancer) {
    const int code = __real_rrcb_balancer_create(comm, balancer);
    return for_many_ranks(code, *balancer);
}

int __wrap_rrcb_balancer_create_fortran(MPI_Fint comm, rrcb_balancer** balancer) {
    const int code = __real_rrcb_balancer_create_fortran(comm, balancer);
    return for_many_ranks(code, *balancer);
}
