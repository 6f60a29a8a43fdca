/* Stands in front of Zoltan, or of the plug-in, and forwards: writes what a program asks of
 * Zoltan's balancer to the file that RRCB_TEST_CALLS names, as lines "name value": calls, seconds
 * (in them, of the rank that spent most), exported (objects, where they are listed), method (the
 * last LB_METHOD), plug_in (1 when it is behind). */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>
#include <zoltan.h>

static int calls = 0;
static double seconds = 0;
static double exported = 0;
static char method[32] = "RCB"; /* Zoltan's default */

static void* next(const char* name) {
    void* function = dlsym(RTLD_NEXT, name);
    if (function != NULL) return function;
    fprintf(stderr, "zoltan_calls: there is no %s\n", name);
    MPI_Abort(MPI_COMM_WORLD, 1);
    return NULL;
}

static int note(double start, int code, const int* num_export) {
    seconds += MPI_Wtime() - start;
    ++calls;
    if (*num_export > 0) exported += *num_export;
    return code;
}

int Zoltan_Set_Param(struct Zoltan_Struct* zz, const char* name, const char* value) {
    int (*set)(struct Zoltan_Struct*, const char*, const char*) = next("Zoltan_Set_Param");
    if (strcasecmp(name, "LB_METHOD") == 0) snprintf(method, sizeof method, "%s", value);
    return set(zz, name, value);
}

int Zoltan_LB_Partition(struct Zoltan_Struct* zz, int* changes, int* num_gid, int* num_lid,
                        int* num_import, ZOLTAN_ID_PTR* import_gids, ZOLTAN_ID_PTR* import_lids,
                        int** import_ranks, int** import_parts, int* num_export,
                        ZOLTAN_ID_PTR* export_gids, ZOLTAN_ID_PTR* export_lids, int** export_ranks,
                        int** export_parts) {
    int (*partition)(struct Zoltan_Struct*, int*, int*, int*, int*, ZOLTAN_ID_PTR*, ZOLTAN_ID_PTR*,
                     int**, int**, int*, ZOLTAN_ID_PTR*, ZOLTAN_ID_PTR*, int**, int**) =
        next("Zoltan_LB_Partition");
    const double start = MPI_Wtime();
    const int code =
        partition(zz, changes, num_gid, num_lid, num_import, import_gids, import_lids, import_ranks,
                  import_parts, num_export, export_gids, export_lids, export_ranks, export_parts);
    return note(start, code, num_export);
}

int Zoltan_LB_Balance(struct Zoltan_Struct* zz, int* changes, int* num_gid, int* num_lid,
                      int* num_import, ZOLTAN_ID_PTR* import_gids, ZOLTAN_ID_PTR* import_lids,
                      int** import_ranks, int* num_export, ZOLTAN_ID_PTR* export_gids,
                      ZOLTAN_ID_PTR* export_lids, int** export_ranks) {
    int (*balance)(struct Zoltan_Struct*, int*, int*, int*, int*, ZOLTAN_ID_PTR*, ZOLTAN_ID_PTR*,
                   int**, int*, ZOLTAN_ID_PTR*, ZOLTAN_ID_PTR*, int**) = next("Zoltan_LB_Balance");
    const double start = MPI_Wtime();
    const int code = balance(zz, changes, num_gid, num_lid, num_import, import_gids, import_lids,
                             import_ranks, num_export, export_gids, export_lids, export_ranks);
    return note(start, code, num_export);
}

int MPI_Finalize(void) {
    const char* path = getenv("RRCB_TEST_CALLS");
    int rank = 0;
    double longest = 0, all_exported = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    PMPI_Reduce(&seconds, &longest, 1, MPI_DOUBLE, MPI_MAX, 0, MPI_COMM_WORLD);
    PMPI_Reduce(&exported, &all_exported, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0 && path != NULL) {
        FILE* file = fopen(path, "w");
        if (file == NULL) MPI_Abort(MPI_COMM_WORLD, 1);
        fprintf(file, "calls %d\nseconds %.6f\nexported %.0f\nmethod %s\nplug_in %d\n", calls,
                longest, all_exported, method, dlsym(RTLD_NEXT, "RRCB_Zoltan_Active") != NULL);
        fclose(file);
    }
    return PMPI_Finalize();
}
