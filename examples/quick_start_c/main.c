// The quick start in C: balances points that are unevenly distributed over the ranks, and moves
// them.
#include <rrcb/rrcb.h>

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

// Ends all ranks if a call fails. The error is the same on each rank.
static void check(int code) {
    if (code == RRCB_OK) return;
    fprintf(stderr, "%s\n", rrcb_last_error());
    MPI_Abort(MPI_COMM_WORLD, code);
}

// Returns the points of this rank. Unit squares of 40 x 40 points form a row; rank r has r + 1 of
// them, which follow those of rank r - 1.
static double* squares_of(int rank, size_t* count) {
    *count = (size_t)(rank + 1) * 1600;
    double* coordinates = malloc(2 * *count * sizeof *coordinates);
    double* x = coordinates;
    for (int i = 0; i < 40 * (rank + 1); ++i) {
        for (int j = 0; j < 40; ++j) {
            *x++ = rank * (rank + 1) / 2 + (i + 0.5) / 40;
            *x++ = (j + 0.5) / 40;
        }
    }
    return coordinates;
}

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    size_t count = 0;
    double* coordinates = squares_of(rank, &count);
    int32_t* parts = malloc(count * sizeof *parts);

    rrcb_balancer* balancer = NULL;
    check(rrcb_balancer_create(MPI_COMM_WORLD, &balancer));
    check(rrcb_balancer_set(balancer, "imbalance_tolerance", "1.02"));
    const rrcb_points points = rrcb_interleaved_points(RRCB_DOUBLE, 2, count, coordinates, NULL);
    check(rrcb_balance(balancer, &points, parts));
    check(rrcb_plan(balancer, count, parts));

    rrcb_plan_lists plan = RRCB_PLAN_LISTS_INIT;
    check(rrcb_get_plan(balancer, &plan));
    double* here = malloc(2 * plan.num_points_after * sizeof *here);
    const rrcb_column column = RRCB_COLUMN_INIT(RRCB_DOUBLE, 2, coordinates, here);
    check(rrcb_transfer(balancer, 1, &column, NULL));

    rrcb_report report = RRCB_REPORT_INIT;
    check(rrcb_get_report(balancer, &report));
    if (rank == 0) {
        printf("%lld points, imbalance %.4f\n", (long long)report.num_points, report.imbalance);
        printf("rank 0 sends %zu points, receives %zu and holds %zu\n", plan.num_exports,
               plan.num_imports, plan.num_points_after);
    }
    rrcb_balancer_destroy(&balancer);
    free(here);
    free(parts);
    free(coordinates);
    MPI_Finalize();
    return 0;
}

// Output on 4 ranks:
// 16000 points, imbalance 1.0000
// rank 0 sends 0 points, receives 2400 and holds 4000
