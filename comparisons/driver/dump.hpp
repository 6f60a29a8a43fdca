#pragma once

#include <string>
#include <utility>
#include <vector>

namespace comparisons {

/// What holds for all ranks of a call that the plug-in has dumped; README.md has the format.
struct DumpedCall {
    std::string function;
    int code = 0;
    int num_ranks = 0;
    std::vector<std::pair<std::string, std::string>> parameters;
};

/// What one rank of it got.
struct DumpedRank {
    int dimension = 0;
    int num_weights = 0;  ///< per point
    std::size_t count = 0;
    std::string message;              ///< of an error; empty: none
    std::vector<double> coordinates;  ///< interleaved; may be NaN or infinite
    std::vector<double> weights;      ///< the first of each point, if there is any
};

/// Reads call.txt of a dump. Not collective.
///
/// Throws Failure that names file, line and fault; also when there are files of more ranks.
DumpedCall read_dumped_call(const std::string& folder);

/// Reads rank-N.txt of a dump, all of it or what stands before the points. Not collective.
///
/// Throws Failure that names file, line and fault.
DumpedRank read_dumped_rank(const std::string& folder, int rank, bool with_points);

}  // namespace comparisons
