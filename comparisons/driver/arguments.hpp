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

/// What of a scene is run.
enum class Only { all, calls, simulations };

/// How methods are measured.
struct MeasurementPlan {
    Lists lists = Lists::parts;
    int repeats = 6;
    std::uint64_t seed = 1;  ///< of a cloud, its layout and the order of turns
    GhostRule ghosts{};
};

/// What the user asks for; see README.md beside this folder for every option.
struct Arguments : MeasurementPlan {
    int ranks = 0;                ///< 0: whatever the program was started with
    std::string scene = "slope";  ///< its name, or a file
    std::string cloud;            ///< empty: not a cloud
    std::string file;             ///< empty: not a file
    std::string replay;  ///< folder of a dump; empty: none; with none of the three: a scene
    rrcb::GlobalCount points = 1'000'000;
    int dimension = 2;
    Layout layout = Layout::sorted;
    std::vector<Method> methods;
    int steps = 0;                 ///< of the simulation; 0: to the end of the scene
    std::vector<int> every = {0};  ///< steps between rebalances; 0: a controller says when
    Cost cost = Cost::count;  ///< learned: the simulations also compare learned costs with counting
    std::string out = "comparisons/out";
    Only only = Only::all;
    bool data = true;  ///< write the points and boxes of which pictures are drawn
    bool quick = false;
    bool progress = false;
    std::optional<std::string> help;  ///< print this and stop
    bool version = false;
};

/// Reads the command line. Not collective.
///
/// Throws Failure that names the option, what is wrong with it and what is possible.
Arguments read_arguments(int argc, char** argv);

}  // namespace comparisons
