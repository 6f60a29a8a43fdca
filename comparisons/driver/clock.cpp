// Runs one round of complete simulations with several balancers, in random order, and prints CSV.
//
//   mpirun -n 2 rrcb_clock splash|pile ROUND POINTS STEPS
//
// The scene splash is SPH: a layer of water under drops. The scene pile is DEM: a heap of grains
// with loose grains above. Both are up to 1.5 times as high as wide, so that cutting the longest
// axis is the worse choice.
#include "clock_particles_mpi.hpp"
#include "counter_random.hpp"
#include "failure.hpp"
#include "partitioner_mpi.hpp"
#include "row.hpp"

#include <rrcb/experimental/cost.hpp>
#include <rrcb/rrcb.hpp>

#include <exception>
#include <iostream>
#include <string>

namespace {

using namespace comparisons;

struct Arm {
    const char* call;
    const char* cuts;
    const char* weights;  ///< `ghosts`: learned weights, with a column of ghosts
    bool again = false;   ///< the second of two runs with equal settings
};

constexpr Arm arms[] = {{"zoltan-rcb", "longest", "count"},   {"zoltan-rcb", "fewest", "count"},
                        {"rrcb", "longest", "count"},         {"rrcb", "fewest", "count"},
                        {"zoltan-rcb", "longest", "learned"}, {"zoltan-rcb", "fewest", "learned"},
                        {"rrcb", "longest", "learned"},       {"rrcb", "fewest", "learned"},
                        {"rrcb", "fewest", "ghosts"},         {"rrcb", "fewest", "count", true}};

constexpr int steps_between_lists = 10;
constexpr int steps_between_calls = 50;

ZoltanParameters parameters_of(const Arm& arm) {
    const bool longest = arm.cuts == std::string("longest");
    const bool ours = arm.call == std::string("rrcb");
    const Method method = read_method(!ours     ? "zoltan-rcb[reuse]"
                                      : longest ? "rrcb[reuse,axes=longest]"
                                                : "rrcb[reuse]");
    ZoltanParameters parameters = zoltan_parameters(method, Lists::parts);
    parameters.emplace_back("REMAP", "0");
    parameters.emplace_back("IMBALANCE_TOL", "1.01");
    return parameters;
}

/// The seconds and the counts of one simulation.
struct Run {
    double wall = 0;
    double calls = 0;
    double ghosts = 0;  ///< on all ranks, mean over the lists
    double moved = 0;   ///< number of points moved in the simulation
};

class Loop {
  public:
    Loop(const Arm& arm, const Scene& scene, MPI_Comm comm)
        : comm_(comm),
          learns_(arm.weights != std::string("count")),
          columns_(arm.weights == std::string("ghosts") ? 3 : 2),
          model_(comm, columns_),
          particles_(scene, comm),
          sees_x_only_(arm.call == std::string("zoltan-rcb") && arm.cuts == std::string("fewest")),
          zoltan_(parameters_of(arm), {"", "", 2, {}, learns_, {}}, comm) {}

    Run run(int num_steps) {
        MPI_Barrier(comm_);
        const double start = MPI_Wtime();
        for (int step = 0; step < num_steps; ++step) {
            if (step % steps_between_calls == 0) rebalance();
            if (step % steps_between_lists == 0) {
                particles_.make_lists(steps_between_lists);
                run_.ghosts += static_cast<double>(particles_.num_ghosts());
            }
            const double work = particles_.step();
            if (!learns_) continue;
            double columns[] = {static_cast<double>(particles_.size()), particles_.num_pairs(),
                                static_cast<double>(particles_.num_ghosts())};
            model_.step(work, std::span(columns).first(width()));
        }
        MPI_Barrier(comm_);
        run_.wall = MPI_Wtime() - start;
        run_.ghosts /= (num_steps + steps_between_lists - 1) / steps_between_lists;
        for (double* number : {&run_.ghosts, &run_.moved})
            MPI_Allreduce(MPI_IN_PLACE, number, 1, MPI_DOUBLE, MPI_SUM, comm_);
        MPI_Allreduce(MPI_IN_PLACE, &run_.calls, 1, MPI_DOUBLE, MPI_MAX, comm_);
        return run_;
    }

  private:
    std::size_t width() const { return static_cast<std::size_t>(columns_); }

    void rebalance() {
        std::vector<double> weights;
        if (learns_) weights = model_.weights(particles_.rows(width()));
        const double start = MPI_Wtime();
        rrcb::Points points(particles_.positions(), 2, weights);
        if (sees_x_only_) points.dimension = 1;
        zoltan_.use_points(points);
        zoltan_.free_lists();
        if (zoltan_.partition() < 0) throw Failure("Zoltan_LB_Partition failed");
        run_.calls += MPI_Wtime() - start;
        run_.moved += static_cast<double>(particles_.move(zoltan_.parts()));
    }

    MPI_Comm comm_;
    bool learns_;
    int columns_;
    rrcb::experimental::CostModel model_;
    Particles particles_;
    /// RCB_SET_DIRECTIONS fixes the order of the cuts, but each cut is across the longest axis.
    /// Hiding y makes Zoltan cut across x.
    bool sees_x_only_;
    ZoltanPartitioner zoltan_;
    Run run_{};
};

void measure(const std::string& name, int round, std::int64_t points, int steps, MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    bool is_first = true;
    for (const std::size_t k :
         drawn_order(std::size(arms), 1, 2 * static_cast<std::uint64_t>(round))) {
        const Arm& arm = arms[k];
        const Run run = Loop(arm, scene_of(name, points), comm).run(steps);
        const Row row = Row()
                            .add("scene", name)
                            .add("round", round)
                            .add("call", arm.call)
                            .add("cuts", arm.cuts)
                            .add("weights", arm.weights)
                            .add("again", static_cast<int>(arm.again))
                            .add("points", static_cast<double>(points))
                            .add("steps", steps)
                            .add("wall_s", run.wall)
                            .add("calls_s", run.calls)
                            .add("ghosts", run.ghosts)
                            .add("moved", run.moved);
        if (rank == 0 && std::exchange(is_first, false)) std::cout << row.header() << '\n';
        if (rank == 0) std::cout << row.text() << std::endl;
    }
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    float version = 0;
    Zoltan_Initialize(argc, argv, &version);
    try {
        if (argc != 5) throw Failure("a scene, round, points and steps are needed; see the source");
        measure(argv[1], std::stoi(argv[2]), std::stoll(argv[3]), std::stoi(argv[4]),
                MPI_COMM_WORLD);
    } catch (const std::exception& error) {
        std::cerr << "rrcb_clock: " << error.what() << '\n';
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    MPI_Finalize();
    return 0;
}
