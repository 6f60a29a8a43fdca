#pragma once

#include "workload_mpi.hpp"

#include <istream>
#include <string>
#include <vector>

namespace comparisons {

/// Reads points from CSV with the header x,y[,z][,weight] and one point per line. Not collective.
///
/// Coordinates must be finite, weights finite and not negative. Throws Failure with the name
/// `file`, the line and column, and the text expected there.
Workload read_points(std::istream& input, const std::string& file);

/// Reads points from a file like read_points. Not collective. Throws Failure if it cannot be
/// opened.
Workload read_points_file(const std::string& file);

/// A call that the plug-in has dumped. docs/errors.md describes the files.
struct Dump {
    Workload workload;                      ///< points of all ranks in order, including NaN and inf
    std::vector<rrcb::GlobalCount> counts;  ///< points of each rank
    std::string note;                       ///< lines that describe the call
};

/// Reads a dump. If points have several weights, only the first is used. Not collective.
///
/// Throws Failure that contains the file, the line and the mistake. It also throws if the folder
/// contains files of more ranks than the call had.
Dump read_dump(const std::string& folder);

}  // namespace comparisons
