#pragma once

#include "workload_mpi.hpp"

#include <istream>
#include <string>

namespace comparisons {

/// Reads points from CSV with the header x,y[,z][,weight], one point a line. Not collective.
///
/// Coordinates must be finite, weights finite and not negative. Throws Failure that names `file`,
/// line and column, and what is expected there.
Workload read_points(std::istream& input, const std::string& file);

/// read_points of a file by name. Not collective. Throws Failure when it cannot be opened.
Workload read_points_file(const std::string& file);

}  // namespace comparisons
