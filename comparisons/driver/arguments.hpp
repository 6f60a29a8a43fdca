#pragma once

#include "ghosts_mpi.hpp"
#include "method.hpp"
#include "simulation_mpi.hpp"
#include "workload_mpi.hpp"

#include <rrcb/points.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace comparisons {

/// The measurements of a scene that are run.
enum class Only { all, calls, simulations };

/// The settings of a measurement.
struct MeasurementPlan {
    Lists lists = Lists::parts;
    int repeats = 6;
    std::uint64_t seed = 1;  ///< for the points of a cloud, their layout and the order of turns
    GhostRule ghosts{};
    bool progress = false;  ///< show on standard error how much is done
};

/// The options of the command line; README.md in the parent folder describes each of them.
struct Arguments : MeasurementPlan {
    int ranks = 0;                ///< 0: the number that the program was started with
    std::string scene = "slope";  ///< the name of a scene, or a file
    std::string cloud;            ///< name of a cloud; empty: none
    std::string file;             ///< file of points; empty: none
    std::string replay;  ///< folder of a dump; empty: none. The scene is used if cloud, file and
                         ///< replay are empty
    rrcb::GlobalCount points = 1'000'000;
    int dimension = 2;
    Layout layout = Layout::sorted;
    std::vector<Method> methods;
    int steps = 0;  ///< number of steps of the simulation; 0: until the end of the scene
    int from = 0;   ///< number of steps of the scene before the simulations begin
    std::vector<int> every = {0};  ///< steps between rebalances; 0: a controller decides
    int record_every = 0;     ///< steps between records of a simulation; 0: as many as a file holds
    Cost cost = Cost::count;  ///< `learned` adds simulations that weigh points by their costs
    std::string out = "comparisons/out";
    Only only = Only::all;
    bool data = true;     ///< write the points and boxes that pictures show
    bool serial = false;  ///< add a simulation on rank 0 alone
    bool quick = false;
    std::optional<std::string> help;  ///< text to print instead of running
};

/// Reads the command line. Not collective.
///
/// Throws Failure that contains the option, the mistake and the allowed values.
Arguments read_arguments(int argc, char** argv);

}  // namespace comparisons
