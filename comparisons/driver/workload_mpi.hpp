#pragma once

#include "cloud.hpp"

#include <rrcb/points.hpp>

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

namespace comparisons {

/// The points of one rank that every method divides.
struct Workload {
    std::string name;
    std::string layout;  ///< distribution of the points over the ranks: sorted, scattered or
                         ///< simulation
    int dimension = 2;
    std::vector<double> coordinates;  ///< interleaved
    bool weighted = false;            ///< is the same on every rank
    std::vector<double> weights;      ///< one per point if weighted, else empty

    rrcb::Points points() const { return rrcb::Points(coordinates, dimension, weights); }
};

/// The distribution of the points over the ranks before they are balanced.
enum class Layout {
    sorted,    ///< each rank has a section with equally many points of a Hilbert curve
    scattered  ///< each point is on a random rank
};

const char* layout_name(Layout layout);

/// Returns the box around the boxes of all ranks. Collective over `comm`.
rrcb::Box joined_box(rrcb::Box mine, MPI_Comm comm);

/// Returns the number of bits per axis of the curve. It has 2^16 cells in 2-D and 2^18 in 3-D.
constexpr int hilbert_bits(int dimension) {
    return dimension == 2 ? 8 : 6;
}

/// Returns the number of cells along the curve.
constexpr std::size_t hilbert_cells(int dimension) {
    return std::size_t{1} << (hilbert_bits(dimension) * dimension);
}

/// Returns the index on the Hilbert curve through `box` of a position inside it. The curve uses
/// `bits` bits per axis.
///
/// See Skilling: Programming the Hilbert curve (2004).
std::size_t hilbert_cell(const rrcb::Box& box, const rrcb::Vector& position, int dimension,
                         int bits);

/// Generates a cloud. Every rank generates its share. Collective over `comm`.
///
/// The point set does not depend on the number of ranks. Throws Failure for an unknown name.
Workload cloud_workload(const Cloud& cloud, Layout layout, MPI_Comm comm);

/// Reads a file of points on rank 0 and sends each rank its share. Collective over `comm`.
///
/// Throws Failure on every rank with the message of read_points.
Workload file_workload(const std::string& file, Layout layout, std::uint64_t seed, MPI_Comm comm);

/// The points of a dumped call, and a description of the call.
struct Replay {
    Workload workload;
    std::string note;  ///< lines, on rank 0
};

/// Reads a dump of the plug-in on rank 0 and sends each rank its share. Collective over `comm`.
///
/// If the number of ranks is that of the dumped call, each rank gets the points that it had.
/// Otherwise the points are distributed in their order, equally many to each rank. Throws Failure
/// on every rank with the message of read_dump.
Replay read_replay(const std::string& folder, MPI_Comm comm);

}  // namespace comparisons
