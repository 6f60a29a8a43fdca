#pragma once

#include "partitioner.hpp"

#include <mpi.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace comparisons {

/// Points of this rank as plain arrays, borrowed.
struct MultijaggedPoints {
    std::size_t count = 0;
    std::vector<const double*> axes;
    int stride = 1;                   ///< of the coordinates along an axis
    const double* weights = nullptr;  ///< null: all 1
};

/// Zoltan2's multijagged, with its imbalance_tolerance. Collective over `comm`. Zoltan2's headers
/// are no C++20, so this one holds nothing of it.
std::unique_ptr<Partitioner> make_multijagged(const MultijaggedPoints& points, double tolerance,
                                              MPI_Comm comm);

/// A division into closed boxes, open outwards; ties may be on either side of a cut.
struct MultijaggedBoxes {
    std::vector<int> parts;                           ///< of the local points
    std::vector<std::array<double, 3>> lower, upper;  ///< of each part
};

/// Divides into one part per rank as make_multijagged does, by a new problem of Zoltan2 at each
/// call, because the points are other ones. Collective over `comm`; throws std::runtime_error.
MultijaggedBoxes divide_multijagged(const MultijaggedPoints& points, double tolerance,
                                    MPI_Comm comm);

}  // namespace comparisons
