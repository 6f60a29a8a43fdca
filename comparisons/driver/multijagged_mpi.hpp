#pragma once

#include "partitioner.hpp"

#include <mpi.h>

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

}  // namespace comparisons
