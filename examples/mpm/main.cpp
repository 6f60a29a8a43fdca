#include "rrcb_balancer_mpi.hpp"

#include <Teuchos_CommandLineProcessor.hpp>
#include <mpi.h>
#include <mpm/simulation.hpp>
#include <mpm/slope.hpp>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

namespace {

struct Arguments {
    std::string balancer = "rrcb";
    int every = 0;
    double end_time = 0;
    int cells = 0;
    double cohesion = 0;
};

/// The number an option was given; throws what is wrong with the text.
template <typename Number>
Number number(const std::string& option, const std::string& text, Number least) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value >= least) ||
        !std::isfinite(static_cast<double>(value)))
        throw std::invalid_argument("--" + option + ": '" + text +
                                    "' is not a number of at least " + std::to_string(least));
    return value;
}

/// False when the user only asked for help; throws what is wrong with the arguments.
///
/// Teuchos tells of some errors on rank 0 only; the code it returns is the same on all ranks.
bool parse(int argc, char** argv, Arguments& arguments) {
    std::string every = "10", end_time = "8", cohesion = "10e3";
    std::string cells = std::to_string(mpm::paper_slope_cells);
    Teuchos::CommandLineProcessor parser(false, true);
    parser.setDocString("A slope that is too steep fails and runs out.");
    parser.setOption("balancer", &arguments.balancer, "none (equal slabs) or rrcb");
    parser.setOption("every", &every, "steps between two rebalances");
    parser.setOption("end-time", &end_time, "simulated seconds");
    parser.setOption("cells", &cells, "cells across the 110 m of the slope");
    parser.setOption("cohesion", &cohesion, "Pa");
    const auto outcome = parser.parse(argc, argv);
    if (outcome == Teuchos::CommandLineProcessor::PARSE_HELP_PRINTED) return false;
    if (outcome != Teuchos::CommandLineProcessor::PARSE_SUCCESSFUL)
        throw std::invalid_argument("an option is not known; --help lists them all");
    if (arguments.balancer != "none" && arguments.balancer != "rrcb")
        throw std::invalid_argument("--balancer: '" + arguments.balancer +
                                    "' is neither none nor rrcb");
    arguments.every = number("every", every, 1);
    arguments.end_time = number("end-time", end_time, 0.0);
    arguments.cells = number("cells", cells, 11);
    arguments.cohesion = number("cohesion", cohesion, 0.0);
    return true;
}

struct Summary {
    double largest_displacement = 0;  ///< m
    double front = 0;                 ///< largest x of a point that has moved a metre, m
    double imbalance = 1;             ///< points of the heaviest rank / mean
};

Summary summarize(const mpm::Simulation& simulation, MPI_Comm comm) {
    const mpm::Particles& particles = simulation.particles();
    const auto x = particles["x"];
    const auto across = particles["displacement_x"], up = particles["displacement_y"];
    double worst[3] = {0, 0, static_cast<double>(particles.size())};
    for (std::size_t p = 0; p < particles.size(); ++p) {
        const double displacement = std::hypot(across[p], up[p]);
        worst[0] = std::max(worst[0], displacement);
        if (displacement > 1) worst[1] = std::max(worst[1], x[p]);
    }
    MPI_Allreduce(MPI_IN_PLACE, worst, 3, MPI_DOUBLE, MPI_MAX, comm);
    int num_ranks = 1;
    MPI_Comm_size(comm, &num_ranks);
    return {worst[0], worst[1],
            worst[2] * num_ranks / static_cast<double>(simulation.num_points())};
}

void show_progress(const mpm::Simulation& simulation, double end_time) {
    if (!isatty(STDERR_FILENO) || simulation.step_count() % 20 != 0) return;
    std::fprintf(stderr, "\r%6.2f of %.2f s", std::min(simulation.time(), end_time), end_time);
}

void print_start(const mpm::Simulation& simulation) {
    std::printf("slope: %lld material points\nkernels:",
                static_cast<long long>(simulation.num_points()));
    for (const std::string& name : simulation.kernels()) std::printf(" %s", name.c_str());
    std::printf("\n");
}

void print_end(const mpm::Simulation& simulation, const Summary& summary, double seconds) {
    const double steps = static_cast<double>(simulation.step_count());
    const double point_steps = steps * static_cast<double>(simulation.num_points());
    std::printf("%lld steps to %.3f s in %.2f s: %.1f million point-steps/s\n",
                static_cast<long long>(simulation.step_count()), simulation.time(), seconds,
                point_steps / seconds * 1e-6);
    std::printf("largest displacement %.3f m, front at x = %.2f m, imbalance %.4f\n",
                summary.largest_displacement, summary.front, summary.imbalance);
}

void run(const Arguments& arguments, MPI_Comm comm) {
    int rank = 0;
    MPI_Comm_rank(comm, &rank);
    mpm::Scene scene = mpm::slope_scene(arguments.cells);
    scene.mohr_coulomb->cohesion = arguments.cohesion;
    mpm::Simulation simulation(scene, comm);
    if (rank == 0) print_start(simulation);

    const mpm::Balancer balancer = rrcb_balancer();
    const double start = MPI_Wtime();
    while (simulation.time() < arguments.end_time) {
        if (arguments.balancer == "rrcb" && simulation.step_count() % arguments.every == 0)
            simulation.rebalance(balancer);
        simulation.step();
        if (rank == 0) show_progress(simulation, arguments.end_time);
    }
    const double seconds = MPI_Wtime() - start;
    const Summary summary = summarize(simulation, comm);
    if (rank == 0) print_end(simulation, summary, seconds);
}

}  // namespace

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    int exit_code = 0;
    try {
        Arguments arguments;
        if (parse(argc, argv, arguments)) run(arguments, MPI_COMM_WORLD);
    } catch (const std::exception& error) {
        if (rank == 0) std::fprintf(stderr, "rrcb_mpm: %s\n", error.what());
        exit_code = 1;
    }
    MPI_Finalize();
    return exit_code;
}
