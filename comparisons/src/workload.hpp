#pragma once

#include <rrcb/points.hpp>

#include <string>
#include <vector>

namespace comparisons {

/// The points of one rank that every method has to divide.
struct Workload {
    std::string name;
    std::string layout;  ///< how the points lie on the ranks: sorted, scattered or simulation
    int dimension = 2;
    std::vector<double> coordinates;  ///< interleaved
    bool weighted = false;            ///< the same on every rank
    std::vector<double> weights;      ///< one per point if weighted, else empty

    rrcb::Points points() const {
        return rrcb::interleaved_points(coordinates, dimension, weights);
    }
};

}  // namespace comparisons
