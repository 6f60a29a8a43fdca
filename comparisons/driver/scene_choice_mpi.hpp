#pragma once

#include <mpi.h>
#include <mpm/scene.hpp>

#include <string>
#include <vector>

namespace comparisons {

/// Returns the names of the shipped scenes that serve as workloads, separated by commas.
std::string scene_names();

/// Throws Failure unless the text is one of these names or the name of a .yaml file. Not
/// collective.
void check_scene(const std::string& name_or_file);

/// Returns the scene to compare, with coarser cells if `quick`. Collective over `comm`.
///
/// Shipped scenes are read from their files. Throws Failure on every rank with the message of
/// mpm::read_scene.
mpm::Scene choose_scene(const std::string& name_or_file, bool quick, MPI_Comm comm);

/// Instructions of a step of a scene for a unit of each of mpm::Simulation::work_columns(), as
/// `comparisons/studies/run work` finds them; those of the slope for a file. Not collective.
std::vector<double> unit_costs(const std::string& name_or_file);

}  // namespace comparisons
