#pragma once

#include <rrcb/points.hpp>

namespace rrcb {

/// Regular grid over the bounding box of one rank's points. Cells are numbered fastest along axis
/// 0. An axis of zero extent has a single layer of cells.
struct SupportMesh {
    int dimension = 0;  ///< of the points
    Box box;            ///< bounding box of the points, which the cells cover
    Box frame;  ///< `box` or a smaller box, which is divided evenly; the outermost layers reach to
                ///< `box`
    std::array<int, max_dimension> cells{1, 1, 1};  ///< number of cells along each axis
    Vector scale{1, 1, 1};      ///< power of two that keeps squares of coordinates in range
    Vector cells_per_length{};  ///< cells per scaled length of the frame; 0 on an axis of zero
                                ///< extent
};

/// Lays a mesh over a box. Not collective.
///
/// @param box            of the points
/// @param dimension      of the points
/// @param cells_per_axis 1 or more
/// Throws Error for less than one cell, or an illegal dimension.
SupportMesh make_support_mesh(const Box& box, int dimension, int cells_per_axis);

/// Returns the number of cells, the product over the axes. Not collective.
RRCB_API LocalIndex num_cells(const SupportMesh& mesh);

/// Returns the cell of a position. Not collective.
///
/// @param mesh     of the points
/// @param position positions outside the mesh go to the nearest cell
LocalIndex cell_of(const SupportMesh& mesh, const Vector& position);

/// Returns the box of a cell; the shared faces of adjacent cells are bit-identical. Not collective.
///
/// @param mesh of the points
/// @param cell number in the mesh
RRCB_API Box cell_box(const SupportMesh& mesh, LocalIndex cell);

}  // namespace rrcb
