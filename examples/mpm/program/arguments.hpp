#pragma once

#include <optional>
#include <string>

/// The command line of rrcb_mpm.
struct Arguments {
    std::string scene;
    std::string balancer;
    std::string out;
    int every = 10;
    int vtk_every = -1;    ///< -1: as the scene says
    double end_time = 0;   ///< s; 0: as the scene says
    double cell_size = 0;  ///< m; 0: as the scene says
    bool list_kernels = false;
};

/// None when the user only asked for help; throws std::invalid_argument that names the option.
/// Not collective; all ranks must be given the same.
std::optional<Arguments> read_arguments(int argc, char** argv);
