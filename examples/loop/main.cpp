// The loop of a particle code, in which each particle meets its neighbours within a cut-off. The
// times of the steps determine when the particles are rebalanced, and how much each of them weighs.
//
// loop [steps [file]]: the run ends after `steps` steps. If the file exists, the run continues from
// it. At the end the run writes the file.
#include "particles.hpp"
#include "restart.hpp"

#include <rrcb/experimental/cost.hpp>
#include <rrcb/rrcb.hpp>

#include <mpi.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

// Here loads and the cost of a rebalance are numbers of pairs, so that all runs print the same. A
// simulation uses the seconds of its own work, and those of its rebalances including the migration.
constexpr double cost = 100000;

// Returns a row of columns for each particle.
std::vector<double> rows_of(const std::vector<double>& neighbours) {
    std::vector<double> rows;
    for (const double count : neighbours) rows.insert(rows.end(), {1.0, count});
    return rows;
}

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    const MPI_Comm comm = MPI_COMM_WORLD;
    int rank = 0;
    int num_ranks = 1;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &num_ranks);
    const int num_steps = argc > 1 ? std::atoi(argv[1]) : 100;
    const bool continues = argc > 2 && std::filesystem::exists(argv[2]);
    Run run;
    if (continues)
        run = read_run(argv[2], comm);
    else
        run.positions = strip_of(rank, num_ranks);
    std::vector<double>& positions = run.positions;
    std::vector<double>& rows = run.rows;
    {
        rrcb::Controller controller =
            continues ? rrcb::load<rrcb::Controller>(run.controller, comm) : rrcb::Controller(comm);
        rrcb::experimental::CostModel model =
            continues ? rrcb::experimental::load_cost_model(run.model, controller)
                      : rrcb::experimental::CostModel(controller, 2);
        if (continues && rank == 0)
            std::printf("continued at step %d: %s\n", run.step, model.report().c_str());
        rrcb::Cuts cuts;
        std::optional<rrcb::Neighbours> neighbours;
        const rrcb::NeighbourOptions options{.cutoff = radius, .travel = travel};
        if (!run.cuts.empty()) {
            cuts = rrcb::load<rrcb::Cuts>(run.cuts);
            neighbours = rrcb::Neighbours(cuts, comm, options);
        }
        std::vector<double> ghosts;
        for (; run.step < num_steps; ++run.step) {
            if (!neighbours || controller.due()) {
                const std::vector<double> weights = model.weights(rows);
                const rrcb::Points points(positions, 2, weights);
                const rrcb::Balance balance = rrcb::balance(points, comm, {}, cuts);
                const rrcb::Plan plan = rrcb::plan(balance, comm);
                positions = rrcb::transfer(plan, rrcb::column(positions, 2), comm);
                cuts = balance.cuts;
                neighbours = rrcb::Neighbours(cuts, comm, options);
                controller.rebalanced({.cost = cost, .report = &balance.report});
                ++run.rebalances;
            } else {
                neighbours->migrate(rrcb::column(positions, 2));
            }
            neighbours->find_ghosts(rrcb::column(positions, 2));
            neighbours->fetch(rrcb::ghosts_of(ghosts), rrcb::column(positions, 2));
            const std::vector<double> counts = count_neighbours(positions, ghosts);
            move(positions);
            rows = rows_of(counts);
            const double load = sum_of(counts);
            model.step(load, {{static_cast<double>(counts.size()), load}});

            double all[] = {load, load};
            MPI_Allreduce(MPI_IN_PLACE, &all[0], 1, MPI_DOUBLE, MPI_MAX, comm);
            MPI_Allreduce(MPI_IN_PLACE, &all[1], 1, MPI_DOUBLE, MPI_SUM, comm);
            run.heaviest += all[0];
            run.total += all[1];
        }
        if (argc > 2) {
            run.controller = save(controller);
            run.model = save(model);
            run.cuts = save(cuts);
            write_run(argv[2], run, comm);
        }
    }
    if (rank == 0) {
        std::printf("%.0f pairs of neighbours met in %d steps\n", run.total, run.step);
        std::printf("%d rebalances, mean imbalance %.9f\n", run.rebalances,
                    run.heaviest * num_ranks / run.total);
    }
    MPI_Finalize();
}

// Output on 4 ranks:
// 66744352 pairs of neighbours met in 100 steps
// 6 rebalances, mean imbalance 1.101568684
