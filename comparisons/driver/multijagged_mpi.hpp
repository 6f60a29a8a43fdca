#pragma once

#include "partitioner.hpp"

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace comparisons {

/// The points of this rank as plain arrays, which must outlive this view.
struct MultijaggedPoints {
    std::size_t count = 0;
    std::vector<const double*> axes;
    int stride = 1;  ///< distance between the coordinates of consecutive points along an axis
    const double* weights = nullptr;  ///< null: all 1
};

/// Returns a partitioner by Zoltan2's multijagged with this imbalance_tolerance. Collective over
/// `comm`. This header includes none of Zoltan2's, because they do not compile as C++20.
std::unique_ptr<Partitioner> make_multijagged(const MultijaggedPoints& points, double tolerance,
                                              MPI_Comm comm);

}  // namespace comparisons
