#pragma once

#include <rrcb/points.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace comparisons {

/// A generated set of points; the same numbers give the same points whatever the number of ranks.
struct Cloud {
    std::string name;  ///< one of cloud_names()
    rrcb::GlobalCount num_points = 0;
    int dimension = 2;  ///< 2 or 3
    std::uint64_t seed = 1;
};

/// Points first ... last - 1 of the cloud, interleaved, in metres. Not collective.
///
/// Each point follows from the seed and its own number alone. Throws Failure for an unknown name.
std::vector<double> cloud_points(const Cloud& cloud, rrcb::GlobalCount first,
                                 rrcb::GlobalCount last);

/// Names of all clouds, as in "a, b, c".
std::string cloud_names();

}  // namespace comparisons
