/* The C side of Zoltan's Fortran interface, as much of it as fortran_client.f90 needs: Debian
 * builds Zoltan without. It hands addresses of Fortran's pointers to Zoltan, which has the arrays
 * allocated by Fortran's own procedures. */
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <zoltan.h>

/* Exported by Zoltan, in no public header. */
void Zoltan_Register_Fort_Malloc(void (*allocate)(void), void (*deallocate)(void),
                                 void (*set_struct)(void));

/* How Zoltan's private structure begins; its flag for Fortran has no setter. */
struct Head {
    MPI_Comm comm;
    int rank, num_ranks, num_gid, num_lid, debug_level, debug_rank, fortran;
};

static struct Zoltan_Struct* handle;
static int (*count_objects)(void);
static void (*list_objects)(int* global_ids, int* local_ids);
static void (*give_positions)(int* count, int* local_ids, double* positions);

void layer_begin_(int* rank, int* num_ranks, void (*allocate)(void), void (*deallocate)(void)) {
    float version;
    MPI_Init(NULL, NULL);
    MPI_Comm_rank(MPI_COMM_WORLD, rank);
    MPI_Comm_size(MPI_COMM_WORLD, num_ranks);
    Zoltan_Initialize(0, NULL, &version);
    Zoltan_Register_Fort_Malloc(allocate, deallocate, NULL);
}

static int count(void* data, int* code) {
    (void)data;
    *code = ZOLTAN_OK;
    return count_objects();
}

static void list(void* data, int num_gid, int num_lid, ZOLTAN_ID_PTR global_ids,
                 ZOLTAN_ID_PTR local_ids, int weight_dimension, float* weights, int* code) {
    (void)data, (void)num_gid, (void)num_lid, (void)weight_dimension, (void)weights;
    *code = ZOLTAN_OK;
    list_objects((int*)global_ids, (int*)local_ids);
}

static int dimension(void* data, int* code) {
    (void)data;
    *code = ZOLTAN_OK;
    return 2;
}

static void positions(void* data, int num_gid, int num_lid, int number, ZOLTAN_ID_PTR global_ids,
                      ZOLTAN_ID_PTR local_ids, int num_dim, double* xy, int* code) {
    (void)data, (void)num_gid, (void)num_lid, (void)num_dim, (void)global_ids;
    *code = ZOLTAN_OK;
    give_positions(&number, (int*)local_ids, xy);
}

/* Marks the handle as Fortran's, where it looks as expected; ids have two words and one. */
static void mark(void) {
    struct Head* head = (struct Head*)handle;
    int rank, num_ranks;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
    const int fits = head->rank == rank && head->num_ranks == num_ranks && head->num_gid == 2 &&
                     head->num_lid == 1 && head->debug_level == 0 && head->fortran == 0;
    if (!fits) {
        printf("Skipped: this Zoltan keeps its flag for Fortran in another place.\n");
        MPI_Finalize();
        exit(77);
    }
    head->fortran = 1;
}

void layer_create_(int (*its_count)(void), void (*its_list)(int*, int*),
                   void (*its_positions)(int*, int*, double*)) {
    count_objects = its_count;
    list_objects = its_list;
    give_positions = its_positions;
    handle = Zoltan_Create(MPI_COMM_WORLD);
    Zoltan_Set_Param(handle, "NUM_GID_ENTRIES", "2");
    Zoltan_Set_Param(handle, "NUM_LID_ENTRIES", "1");
    Zoltan_Set_Param(handle, "DEBUG_LEVEL", "0");
    mark();
    Zoltan_Set_Num_Obj_Fn(handle, count, NULL);
    Zoltan_Set_Obj_List_Fn(handle, list, NULL);
    Zoltan_Set_Num_Geom_Fn(handle, dimension, NULL);
    Zoltan_Set_Geom_Multi_Fn(handle, positions, NULL);
}

int layer_set_param_(const char* name, const char* value) {
    return Zoltan_Set_Param(handle, name, value);
}

/* A copy takes the place of the handle. */
void layer_copy_(void) {
    struct Zoltan_Struct* copy = Zoltan_Copy(handle);
    Zoltan_Destroy(&handle);
    handle = copy;
}

/* Each array is a Fortran pointer, whose address goes behind the place for that of its data. */
int layer_partition_(int* changes, int* num_import, void* import_gids, void* import_lids,
                     void* import_ranks, void* import_parts, int* num_export, void* export_gids,
                     void* export_lids, void* export_ranks, void* export_parts) {
    int num_gid, num_lid;
    ZOLTAN_ID_PTR imported_gids[2] = {NULL, import_gids}, imported_lids[2] = {NULL, import_lids},
                  exported_gids[2] = {NULL, export_gids}, exported_lids[2] = {NULL, export_lids};
    int *imported_ranks[2] = {NULL, import_ranks}, *imported_parts[2] = {NULL, import_parts},
        *exported_ranks[2] = {NULL, export_ranks}, *exported_parts[2] = {NULL, export_parts};
    return Zoltan_LB_Partition(handle, changes, &num_gid, &num_lid, num_import, imported_gids,
                               imported_lids, imported_ranks, imported_parts, num_export,
                               exported_gids, exported_lids, exported_ranks, exported_parts);
}

int layer_rank_of_(double* position) {
    int rank = -1, part = -1;
    Zoltan_LB_Point_PP_Assign(handle, position, &rank, &part);
    return rank;
}

int layer_sum_(const int* value) {
    int sum = 0;
    MPI_Allreduce(value, &sum, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return sum;
}

void layer_end_(void) {
    Zoltan_Destroy(&handle);
    MPI_Finalize();
}
