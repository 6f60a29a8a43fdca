#pragma once

#include "workload_mpi.hpp"

#include <istream>
#include <string>
#include <vector>

namespace comparisons {

/// Reads points from CSV with the header x,y[,z][,weight], one point a line. Not collective.
///
/// Coordinates must be finite, weights finite and not negative. Throws Failure that names `file`,
/// line and column, and what is expected there.
Workload read_points(std::istream& input, const std::string& file);

/// read_points of a file by name. Not collective. Throws Failure when it cannot be opened.
Workload read_points_file(const std::string& file);

/// A call that the plug-in has dumped; docs/errors.md describes the files.
struct Dump {
    Workload workload;                      ///< points of all ranks, in order; NaN and inf too
    std::vector<rrcb::GlobalCount> counts;  ///< points of each rank
    std::string note;                       ///< what to report of the call, in lines
};

/// Reads a dump; of several weights of a point the first. Not collective.
///
/// Throws Failure that names file, line and fault; also when there are files of more ranks.
Dump read_dump(const std::string& folder);

}  // namespace comparisons
