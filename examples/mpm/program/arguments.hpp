#pragma once

#include <optional>
#include <string>

/// The options of the command line of rrcb_mpm.
struct Arguments {
    std::string scene;
    std::string balancer;
    std::string out;
    int every = 0;             ///< steps between rebalances; 0: rebalance when it pays
    bool learns_cost = false;  ///< weigh points by measured time
    int vtk_every = -1;        ///< steps between outputs; -1: as in the scene
    double end_time = 0;       ///< s; 0: as in the scene
    double cell_size = 0;      ///< m; 0: as in the scene
    double every_time = 0;     ///< s between outputs; 0: as in the scene
    int state_every = 0;       ///< steps between written states; 0: none
    std::string restart;       ///< file of the state to continue from; empty: start from the scene
    bool list_kernels = false;
};

/// Returns the arguments of a command line, or nullopt if it only requests help.
///
/// Not collective; all ranks pass the same arguments. Throws std::invalid_argument that names the
/// option.
std::optional<Arguments> read_arguments(int argc, char** argv);
