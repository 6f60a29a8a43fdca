#pragma once

#include <optional>
#include <string>

/// The command line of rrcb_mpm.
struct Arguments {
    std::string scene;
    std::string balancer;
    std::string out;
    int every = 0;             ///< steps between rebalances; 0: when they pay
    bool learns_cost = false;  ///< weighs points by time
    int vtk_every = -1;        ///< -1: as the scene says
    double end_time = 0;       ///< s; 0: as the scene says
    double cell_size = 0;      ///< m; 0: as the scene says
    double every_time = 0;     ///< s between outputs; 0: as the scene says
    int state_every = 0;       ///< steps between written states; 0: none
    std::string restart;       ///< file of a state to go on from; empty: from the scene's start
    bool list_kernels = false;
};

/// Arguments of a command line, or none where it only asks for help.
///
/// Not collective; all ranks pass the same. Throws std::invalid_argument that names the option.
std::optional<Arguments> read_arguments(int argc, char** argv);
