// A step with neighbours makes three messages to each and no collective call; a step that moves
// nothing allocates nothing.
#include "../mpi/neighbours_cases.hpp"
#include "../support/memory_layer.hpp"
#include "mpi_layer.hpp"

namespace rrcb {
namespace {

using test::NeighbourCase;
using test::NeighbourRun;

struct Counts {
    long collectives = 0;
    long messages = 0;
    long allocations = 0;
    long bytes = 0;
};

/// Arrays of a simulation whose memory is there.
struct Arrays {
    std::vector<double> ghost_x, ghost_v, of_ghosts, v, forces;
    std::vector<std::int64_t> ghost_ids;
};

Counts counts_of_step(Neighbours& neighbours, NeighbourRun<double>& run, Arrays& arrays) {
    const std::size_t dim = run.dim();
    mpi_layer::fail_call(0);
    mpi_layer::fail_message(0);
    memory_layer::fail_allocation(0);
    neighbours.migrate(column(run.x(), dim), column(arrays.v, dim), run.ids());
    neighbours.find_ghosts(column(run.x(), dim));
    neighbours.fetch(ghosts_of(arrays.ghost_x, arrays.ghost_v, arrays.ghost_ids),
                     column(run.x(), dim), column(arrays.v, dim), run.ids());
    arrays.of_ghosts.resize(arrays.ghost_x.size());
    arrays.forces.resize(run.x().size());
    neighbours.accumulate(column(arrays.of_ghosts, dim), column(arrays.forces, dim));
    return {mpi_layer::counted_calls(), mpi_layer::counted_messages(),
            memory_layer::counted_allocations(), memory_layer::counted_bytes()};
}

TEST(NeighbourCounts, of_a_step) {
    for (const int dimension : {2, 3}) {
        const NeighbourCase input{.seed = 9,
                                  .dimension = dimension,
                                  .num_points = 20000,
                                  .radius = dimension == 2 ? 0.014 : 0.07,
                                  .travel = 0.005};
        NeighbourRun<double> run(input);
        Neighbours neighbours(run.cuts(), MPI_COMM_WORLD, run.options());
        Arrays arrays;
        arrays.v.resize(run.x().size());
        Counts moving;
        const int num_steps = 20;
        for (int step = 0; step < 10 + num_steps; ++step) {
            run.drift(step);
            const Counts counts = counts_of_step(neighbours, run, arrays);
            if (step < 10) continue;
            moving.allocations += counts.allocations;
            moving.bytes += counts.bytes;
        }
        EXPECT_LE(moving.allocations, 4 * num_steps);
        EXPECT_LE(moving.bytes, 40000 * num_steps);
        counts_of_step(neighbours, run, arrays);
        const Counts still = counts_of_step(neighbours, run, arrays);
        EXPECT_EQ(still.collectives, 0);
        EXPECT_EQ(still.messages, 3 * std::ssize(neighbours.ranks()));
        EXPECT_EQ(still.allocations, 0);
        RecordProperty("allocations", std::to_string(moving.allocations));
    }
}

}  // namespace
}  // namespace rrcb
