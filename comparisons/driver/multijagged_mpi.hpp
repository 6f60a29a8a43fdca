#pragma once

#include <mpi.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace comparisons {

/// Points of this rank as plain arrays, borrowed.
struct MultijaggedPoints {
    std::size_t count = 0;
    int dimension = 2;
    const double* coordinates = nullptr;  ///< interleaved
    const double* weights = nullptr;      ///< null: all 1
};

/// Zoltan2's multijagged partitioner, one part per rank; its headers are no C++20, so this one
/// holds nothing of it.
class Multijagged {
  public:
    /// Collective over `comm`. `tolerance` is Zoltan2's imbalance_tolerance.
    Multijagged(const MultijaggedPoints& points, double tolerance, MPI_Comm comm);
    ~Multijagged();

    /// Partitions anew. Collective; throws std::exception when Zoltan2 fails.
    void partition();

    /// Part of every point of this rank. Not collective.
    std::vector<int> parts() const;

  private:
    struct Problem;
    std::unique_ptr<Problem> problem_;
};

}  // namespace comparisons
