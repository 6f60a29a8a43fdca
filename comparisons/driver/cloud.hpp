#pragma once

#include <rrcb/points.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace comparisons {

/// A generated point set. It does not depend on the number of ranks.
struct Cloud {
    std::string name;  ///< one of cloud_names()
    rrcb::GlobalCount num_points = 0;
    int dimension = 2;  ///< 2 or 3
    std::uint64_t seed = 1;
};

/// Returns the points first ... last - 1 of the cloud, interleaved, in metres. Not collective.
///
/// Each point depends only on the seed and on its number. Throws Failure for an unknown name.
std::vector<double> cloud_points(const Cloud& cloud, rrcb::GlobalCount first,
                                 rrcb::GlobalCount last);

/// Returns the names of all clouds, separated by commas.
std::string cloud_names();

}  // namespace comparisons
