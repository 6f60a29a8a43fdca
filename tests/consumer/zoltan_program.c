/* Rank 0 holds 300 points in a row; after RRCB through Zoltan it must keep 100 of them. */
#include <rrcb/zoltan/rrcb_zoltan.h>

#include <mpi.h>
#include <stdio.h>
#include <zoltan.h>

static int num_points(void* data, int* error) {
    *error = ZOLTAN_OK;
    return *(int*)data;
}

static void list_points(void* data, int num_gid, int num_lid, ZOLTAN_ID_PTR gids,
                        ZOLTAN_ID_PTR lids, int weight_dim, float* weights, int* error) {
    (void)num_gid, (void)num_lid, (void)weight_dim, (void)weights;
    for (int i = 0; i < *(int*)data; ++i) gids[i] = lids[i] = (ZOLTAN_ID_TYPE)i;
    *error = ZOLTAN_OK;
}

static int num_axes(void* data, int* error) {
    (void)data;
    *error = ZOLTAN_OK;
    return 1;
}

static void position(void* data, int num_gid, int num_lid, ZOLTAN_ID_PTR gid, ZOLTAN_ID_PTR lid,
                     double* x, int* error) {
    (void)data, (void)num_gid, (void)num_lid, (void)gid;
    *x = *lid;
    *error = ZOLTAN_OK;
}

int main(int argc, char** argv) {
    float zoltan_version;
    int rank, count, kept, changes, num_gid, num_lid, num_import, num_export;
    int *import_ranks, *import_parts, *export_ranks, *export_parts;
    ZOLTAN_ID_PTR import_gids, import_lids, export_gids, export_lids;

    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    Zoltan_Initialize(argc, argv, &zoltan_version);
    count = rank == 0 ? 300 : 0;

    struct Zoltan_Struct* zoltan = Zoltan_Create(MPI_COMM_WORLD);
    Zoltan_Set_Param(zoltan, "DEBUG_LEVEL", "0");
    int code = Zoltan_Set_Param(zoltan, "LB_METHOD", "RRCB");
    Zoltan_Set_Num_Obj_Fn(zoltan, num_points, &count);
    Zoltan_Set_Obj_List_Fn(zoltan, list_points, &count);
    Zoltan_Set_Num_Geom_Fn(zoltan, num_axes, NULL);
    Zoltan_Set_Geom_Fn(zoltan, position, NULL);
    if (code == ZOLTAN_OK)
        code = Zoltan_LB_Partition(zoltan, &changes, &num_gid, &num_lid, &num_import, &import_gids,
                                   &import_lids, &import_ranks, &import_parts, &num_export,
                                   &export_gids, &export_lids, &export_ranks, &export_parts);
    kept = code == ZOLTAN_OK ? count - num_export + num_import : -1;
    if (code == ZOLTAN_OK) {
        Zoltan_LB_Free_Part(&import_gids, &import_lids, &import_ranks, &import_parts);
        Zoltan_LB_Free_Part(&export_gids, &export_lids, &export_ranks, &export_parts);
    }
    Zoltan_Destroy(&zoltan);

    printf("rank %d: rrcb %s in front of Zoltan: %d, code %d, points %d\n", rank, RRCB_Version(),
           RRCB_Zoltan_Active(), code, kept);
    MPI_Finalize();
    return RRCB_Zoltan_Active() && code == ZOLTAN_OK && kept == 100 ? 0 : 1;
}
