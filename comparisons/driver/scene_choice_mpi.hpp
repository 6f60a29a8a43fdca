#pragma once

#include <mpi.h>
#include <mpm/scene.hpp>

#include <string>

namespace comparisons {

/// Names of the shipped scenes that are workloads, by commas.
std::string scene_names();

/// Throws Failure unless it is one of these names or a file's with the ending .yaml. Not
/// collective.
void check_scene(const std::string& name_or_file);

/// A scene as it is compared, or a coarse one if `quick`. Collective over `comm`.
///
/// Shipped scenes are read from their files. Throws Failure on every rank with
/// the message of mpm::read_scene.
mpm::Scene choose_scene(const std::string& name_or_file, bool quick, MPI_Comm comm);

}  // namespace comparisons
