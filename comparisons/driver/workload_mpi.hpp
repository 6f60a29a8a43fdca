#pragma once

#include "cloud.hpp"

#include <rrcb/points.hpp>

#include <mpi.h>

#include <cstdint>
#include <span>
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

/// Layout of the points on the ranks before they are balanced.
enum class Layout {
    sorted,    ///< each rank holds a piece of equal count of a Hilbert curve through the points
    scattered  ///< each point lies on a random rank
};

const char* layout_name(Layout layout);

/// Box around the boxes of all ranks. Collective over `comm`.
rrcb::Box joined_box(rrcb::Box mine, MPI_Comm comm);

/// Moves each point to its rank; points come in the order of the ranks that held them, and as they
/// lay there. Collective over `comm`.
void move(Workload& workload, std::span<const int> ranks, MPI_Comm comm);

/// Levels of the curve: bits per axis, so that there are 2^16 or 2^18 cells in all.
constexpr int hilbert_bits(int dimension) {
    return dimension == 2 ? 8 : 6;
}

/// Number of cells along the curve.
constexpr std::size_t hilbert_cells(int dimension) {
    return std::size_t{1} << (hilbert_bits(dimension) * dimension);
}

/// Place on the Hilbert curve through `box` of a position inside it, with `bits` of each axis:
/// 0 ... hilbert_cells - 1 by default.
///
/// Skilling: Programming the Hilbert curve (2004).
std::size_t hilbert_cell(const rrcb::Box& box, const rrcb::Vector& position, int dimension,
                         int bits);
inline std::size_t hilbert_cell(const rrcb::Box& box, const rrcb::Vector& position, int dimension) {
    return hilbert_cell(box, position, dimension, hilbert_bits(dimension));
}

/// Generates a cloud, every rank its share. Collective over `comm`.
///
/// The point set does not depend on the number of ranks. Throws Failure for an unknown name.
Workload cloud_workload(const Cloud& cloud, Layout layout, MPI_Comm comm);

/// Reads a file of points on rank 0 and sends every rank its share. Collective over `comm`.
///
/// Throws Failure on every rank with the message of read_points.
Workload file_workload(const std::string& file, Layout layout, std::uint64_t seed, MPI_Comm comm);

/// The points of a dumped call, and what to report of it.
struct Replay {
    Workload workload;
    std::string note;  ///< lines, on rank 0
};

/// Reads a dump of the plug-in's on rank 0 and sends every rank its share. Collective over `comm`.
///
/// Points lie on the ranks they came from if there are as many; otherwise they are dealt out in
/// their order, the same number to each. Throws Failure on every rank with the message of
/// read_dump.
Replay read_replay(const std::string& folder, MPI_Comm comm);

}  // namespace comparisons
