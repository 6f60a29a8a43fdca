/* Usage: some_ranks_client [handles [return | late]]
 *
 * Makes handles and partitions by the first one: a program in which only some ranks may have RRCB.
 * "return": errors of MPI return to the caller, and a missing handle is reported. "late": rank 0
 * comes later than the time limit for the ranks' agreement. */
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zoltan.h>

enum { most_handles = 8 };

static int no_objects(void* data, int* code) {
    (void)data;
    *code = ZOLTAN_OK;
    return 0;
}

static void partition(struct Zoltan_Struct* handle) {
    int changes, num_gid, num_lid, num_import, num_export;
    ZOLTAN_ID_PTR import_gids, import_lids, export_gids, export_lids;
    int *import_ranks, *import_parts, *export_ranks, *export_parts;
    Zoltan_Set_Param(handle, "DEBUG_LEVEL", "0");
    Zoltan_Set_Num_Obj_Fn(handle, no_objects, NULL);
    Zoltan_LB_Partition(handle, &changes, &num_gid, &num_lid, &num_import, &import_gids,
                        &import_lids, &import_ranks, &import_parts, &num_export, &export_gids,
                        &export_lids, &export_ranks, &export_parts);
}

int main(int argc, char** argv) {
    float version;
    int rank;
    struct Zoltan_Struct* handles[most_handles];
    const int num_handles = argc > 1 ? atoi(argv[1]) : 1;
    const char* mode = argc > 2 ? argv[2] : "";

    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    Zoltan_Initialize(argc, argv, &version);
    if (strcmp(mode, "return") == 0) MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    if (strcmp(mode, "late") == 0 && rank == 0) sleep(3);
    for (int i = 0; i < num_handles; ++i) {
        handles[i] = Zoltan_Create(MPI_COMM_WORLD);
        if (handles[i] != NULL) continue;
        printf("rank %d has no handle\n", rank);
        fflush(stdout);
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    partition(handles[0]);
    for (int i = 0; i < num_handles; ++i) Zoltan_Destroy(&handles[i]);
    if (rank == 0) printf("done\n");
    MPI_Finalize();
    return 0;
}
