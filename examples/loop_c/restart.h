// Writes the state of a run to a file, in the format of examples/loop. The same or another number
// of ranks can continue from it.
#ifndef RRCB_EXAMPLES_LOOP_C_RESTART_H
#define RRCB_EXAMPLES_LOOP_C_RESTART_H

#include <mpi.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct bytes {
    const void* data;
    size_t size;
};

// The state of a run between two steps. The numbers are the step, the rebalances, the sum of the
// heaviest loads and the sum of all loads. If there are no cuts, the run must first be divided
// among the ranks.
struct run {
    double numbers[4];
    struct bytes controller, model, cuts;
    size_t count;
    double* positions;
    double* rows;  // for each particle 1 and the number of its neighbours
};

// Writes a record: the number of its values, then the values.
static void put(FILE* file, const void* values, size_t length, size_t size) {
    const uint64_t number = length;
    fwrite(&number, sizeof number, 1, file);
    fwrite(values, size, length, file);
}

static void* next_of(FILE* file, size_t size, size_t* length) {
    uint64_t number = 0;
    if (fread(&number, sizeof number, 1, file) != 1) abort();
    void* values = malloc((number + 1) * size);
    if (fread(values, size, number, file) != number) abort();
    *length = number;
    return values;
}

// Writes the values of all ranks, in the order of the ranks.
static void put_all(FILE* file, const double* mine, size_t length, MPI_Comm comm) {
    int num_ranks = 1;
    MPI_Comm_size(comm, &num_ranks);
    const int count = (int)length;
    int* counts = malloc((size_t)num_ranks * sizeof *counts);
    int* begins = malloc(((size_t)num_ranks + 1) * sizeof *begins);
    MPI_Allgather(&count, 1, MPI_INT, counts, 1, MPI_INT, comm);
    begins[0] = 0;
    for (int k = 0; k < num_ranks; ++k) begins[k + 1] = begins[k] + counts[k];
    const size_t total = (size_t)begins[num_ranks];
    double* all = malloc((total + 1) * sizeof *all);
    MPI_Gatherv(mine, count, MPI_DOUBLE, all, counts, begins, MPI_DOUBLE, 0, comm);
    if (file != NULL) put(file, all, total, sizeof *all);
    free(counts);
    free(begins);
    free(all);
}

// Rank 0 writes the particles of all ranks, and the bytes of the library, which every rank has.
static void write_run(const char* path, const struct run* run, MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    FILE* file = rank == 0 ? fopen(path, "wb") : NULL;
    if (file != NULL) {
        put(file, run->numbers, 4, sizeof(double));
        put(file, run->controller.data, run->controller.size, 1);
        put(file, run->model.data, run->model.size, 1);
        put(file, run->cuts.data, run->cuts.size, 1);
    }
    const double size = 2.0 * (double)run->count;
    put_all(file, &size, 1, comm);
    put_all(file, run->positions, 2 * run->count, comm);
    put_all(file, run->rows, 2 * run->count, comm);
    if (file != NULL) fclose(file);
}

static double* copy_of(double* values, size_t begin, size_t end) {
    double* copy = malloc((end - begin + 1) * sizeof *copy);
    memcpy(copy, values + begin, (end - begin) * sizeof *copy);
    free(values);
    return copy;
}

// Every rank reads the file. If the number of ranks is that of the file, each keeps its own
// particles. Otherwise each takes an equal share, and the cuts are dropped.
static void read_run(FILE* file, struct run* run, MPI_Comm comm) {
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    size_t length = 0;
    double* numbers = next_of(file, sizeof *numbers, &length);
    memcpy(run->numbers, numbers, sizeof run->numbers);
    run->controller.data = next_of(file, 1, &run->controller.size);
    run->model.data = next_of(file, 1, &run->model.size);
    run->cuts.data = next_of(file, 1, &run->cuts.size);
    size_t ranks_before = 0;
    double* sizes = next_of(file, sizeof *sizes, &ranks_before);
    double* positions = next_of(file, sizeof *positions, &length);
    double* rows = next_of(file, sizeof *rows, &length);
    size_t begin = length / 2 * (size_t)rank / (size_t)num_ranks * 2;
    size_t end = length / 2 * ((size_t)rank + 1) / (size_t)num_ranks * 2;
    if (ranks_before == (size_t)num_ranks) {
        begin = 0;
        for (int k = 0; k < rank; ++k) begin += (size_t)sizes[k];
        end = begin + (size_t)sizes[rank];
    } else {
        run->cuts.size = 0;
    }
    run->count = (end - begin) / 2;
    run->positions = copy_of(positions, begin, end);
    run->rows = copy_of(rows, begin, end);
    free(numbers);
    free(sizes);
    fclose(file);
}

#endif
