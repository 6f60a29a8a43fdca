/* Uses Zoltan from C. At first all particles are on rank 0, in a row. After the partition each
 * rank has the same number. Apart from the method's name only one line refers to RRCB: it asks
 * whether the plug-in is available.
 */
#include <rrcb/zoltan/rrcb_zoltan.h>

#include <mpi.h>
#include <stdio.h>
#include <zoltan.h>

static int count_particles(void* data, int* code) {
    *code = ZOLTAN_OK;
    return *(int*)data;
}

static void list_particles(void* data, int num_gid, int num_lid, ZOLTAN_ID_PTR global_ids,
                           ZOLTAN_ID_PTR local_ids, int weight_dimension, float* weights,
                           int* code) {
    (void)num_gid, (void)num_lid, (void)weight_dimension, (void)weights;
    for (int i = 0; i < *(int*)data; ++i) global_ids[i] = local_ids[i] = (ZOLTAN_ID_TYPE)i;
    *code = ZOLTAN_OK;
}

static int dimension_of_space(void* data, int* code) {
    (void)data;
    *code = ZOLTAN_OK;
    return 1;
}

static void give_position(void* data, int num_gid, int num_lid, ZOLTAN_ID_PTR global_id,
                          ZOLTAN_ID_PTR local_id, double* position, int* code) {
    (void)data, (void)num_gid, (void)num_lid, (void)global_id;
    *position = *local_id;
    *code = ZOLTAN_OK;
}

/* Returns the number of particles of this rank after the partition, or -1 if it fails. */
static int balance(struct Zoltan_Struct* zoltan, int count) {
    int changes, num_gid, num_lid, num_import, num_export;
    ZOLTAN_ID_PTR import_gids, import_lids, export_gids, export_lids;
    int *import_ranks, *import_parts, *export_ranks, *export_parts;
    const int code =
        Zoltan_LB_Partition(zoltan, &changes, &num_gid, &num_lid, &num_import, &import_gids,
                            &import_lids, &import_ranks, &import_parts, &num_export, &export_gids,
                            &export_lids, &export_ranks, &export_parts);
    if (code != ZOLTAN_OK && code != ZOLTAN_WARN) return -1;
    Zoltan_LB_Free_Part(&import_gids, &import_lids, &import_ranks, &import_parts);
    Zoltan_LB_Free_Part(&export_gids, &export_lids, &export_ranks, &export_parts);
    return count - num_export + num_import;
}

int main(int argc, char** argv) {
    float version;
    int rank, num_ranks;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
    Zoltan_Initialize(argc, argv, &version);
    if (!RRCB_Zoltan_Active() && rank == 0)
        fprintf(stderr, "RRCB is not in front of Zoltan: link librrcb_zoltan before it.\n");

    int count = rank == 0 ? 300 * num_ranks : 0;
    struct Zoltan_Struct* zoltan = Zoltan_Create(MPI_COMM_WORLD);
    Zoltan_Set_Param(zoltan, "DEBUG_LEVEL", "0");
    int kept = -1;
    if (Zoltan_Set_Param(zoltan, "LB_METHOD", "RRCB") == ZOLTAN_OK) {
        Zoltan_Set_Num_Obj_Fn(zoltan, count_particles, &count);
        Zoltan_Set_Obj_List_Fn(zoltan, list_particles, &count);
        Zoltan_Set_Num_Geom_Fn(zoltan, dimension_of_space, NULL);
        Zoltan_Set_Geom_Fn(zoltan, give_position, NULL);
        kept = balance(zoltan, count);
    }
    Zoltan_Destroy(&zoltan);

    int fewest = 0;
    MPI_Reduce(&kept, &fewest, 1, MPI_INT, MPI_MIN, 0, MPI_COMM_WORLD);
    if (rank == 0) printf("every rank has %d particles or more\n", fewest);
    MPI_Finalize();
    return RRCB_Zoltan_Active() && kept == 300 ? 0 : 1;
}
