#pragma once

#include <rrcb/method/moments.hpp>
#include <rrcb/points.hpp>

#include <span>
#include <vector>

namespace rrcb {

/// Cells or points of all ranks, with the totals of the points.
struct PaperRecords {
    GlobalCount num_points = 0;
    double weight = 0;
    double heaviest = 0;  ///< weight of the heaviest point
    std::vector<CellMoments> cells;
    std::vector<double> coordinates;  ///< interleaved
    std::vector<double> weights;
};

/// Packs the moments of the cells of one rank, or its points, for rank 0.
std::vector<double> pack_moments(const Points& points, std::span<const CellMoments> cells);
std::vector<double> pack_points(const Points& points);

/// Unpacks the data of all ranks, one after the other. Throws Error if the sum of weights
/// overflows.
PaperRecords unpack_moments(std::span<const double> packed, int dimension);
PaperRecords unpack_points(std::span<const double> packed, int dimension);

}  // namespace rrcb
