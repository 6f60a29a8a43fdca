/* A program that holds Zoltan as a static archive and makes a handle, whose default method is RCB.
 */
#include <mpi.h>
#include <zoltan.h>

int main(int argc, char** argv) {
    float version;
    MPI_Init(&argc, &argv);
    Zoltan_Initialize(argc, argv, &version);
    struct Zoltan_Struct* zoltan = Zoltan_Create(MPI_COMM_WORLD);
    const int code = Zoltan_Set_Param(zoltan, "IMBALANCE_TOL", "1.05");
    Zoltan_Destroy(&zoltan);
    MPI_Finalize();
    return code;
}
