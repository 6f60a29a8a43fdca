// The quick start in C: balances points that are unevenly distributed over the ranks, moves them,
// and fetches copies of the points near each rank's box.
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

    const rrcb_points points = rrcb_interleaved_points(RRCB_DOUBLE, 2, count, coordinates, NULL);
    rrcb_balancer* balancer = NULL;
    check(rrcb_balancer_create(MPI_COMM_WORLD, &balancer));
    check(rrcb_balance(balancer, &points, parts));
    check(rrcb_plan(balancer, count, parts));
    rrcb_plan_lists plan = RRCB_PLAN_LISTS_INIT;
    check(rrcb_get_plan(balancer, &plan));

    // Columns of the points in this rank's box, and copies of others within 0.05 of it.
    double* here = malloc(2 * plan.num_points_after * sizeof *here);
    rrcb_column column = RRCB_COLUMN_INIT(RRCB_DOUBLE, 2, coordinates, here);
    check(rrcb_transfer(balancer, 1, &column, NULL));
    const rrcb_points points_here =
        rrcb_interleaved_points(RRCB_DOUBLE, 2, plan.num_points_after, here, NULL);
    rrcb_ghost_options options = RRCB_GHOST_OPTIONS_INIT;
    options.cutoff = 0.05;
    rrcb_ghosts* near = NULL;
    check(rrcb_ghosts_create(balancer, &points_here, &options, &near));
    rrcb_ghost_plan near_plan = RRCB_GHOST_PLAN_INIT;
    check(rrcb_ghosts_get_plan(near, &near_plan));
    double* ghosts = malloc(2 * near_plan.num_ghosts * sizeof *ghosts);
    column.from = here;
    column.to = ghosts;
    check(rrcb_ghosts_fetch(near, 1, &column, NULL));

    double moved = 0;
    check(rrcb_moved_fraction(balancer, &points, parts, &moved));
    rrcb_report report = RRCB_REPORT_INIT;
    check(rrcb_get_report(balancer, &report));
    if (rank == 0) {
        int num_parts = 0;
        MPI_Comm_size(MPI_COMM_WORLD, &num_parts);
        printf("%lld points in %d parts\n", (long long)report.num_points, num_parts);
        printf("imbalance %.4f, moved %.0f %%\n", report.imbalance, 100 * moved);
        printf("rank 0 sends %zu points and receives %zu\n", plan.num_exports, plan.num_imports);
        printf("it has %zu, and copies of %zu near its box\n", plan.num_points_after,
               near_plan.num_ghosts);
    }
    rrcb_ghosts_destroy(&near);
    rrcb_balancer_destroy(&balancer);
    free(ghosts);
    free(here);
    free(parts);
    free(coordinates);
    MPI_Finalize();
    return 0;
}

// Output on 4 ranks:
// 16000 points in 4 parts
// imbalance 1.0000, moved 50 %
// rank 0 sends 0 points and receives 2400
// it has 4000, and copies of 80 near its box
