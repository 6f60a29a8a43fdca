#pragma once

#include "arithmetic/running_sums.hpp"
#include "arithmetic/vector_clones.hpp"
#include "passes/point_layout.hpp"

#include <rrcb/detail/support_mesh.hpp>

#include <cmath>
#include <cstdint>

namespace rrcb {

/// A support mesh in the form that the loop over points needs: one entry per axis.
struct CellFinder {
    explicit CellFinder(const SupportMesh& mesh) : scale(mesh.scale) {
        for (std::size_t a = 0; a < max_dimension; ++a) {
            lower[a] = mesh.frame.lower[a] * mesh.scale[a];
            is_open = is_open || mesh.frame.lower[a] > mesh.box.lower[a];
            cells_per_length[a] = mesh.cells_per_length[a];
            num_cells[a] = static_cast<std::int32_t>(mesh.cells[a]);
            below_num_cells[a] = std::nextafter(mesh.cells[a], 0);
        }
    }

    Vector scale;
    Vector lower{};
    Vector cells_per_length{};
    std::array<std::int32_t, max_dimension> num_cells{};
    Vector below_num_cells{};  ///< largest double below num_cells
    bool is_open = false;      ///< whether points may be below the frame
};

/// As find_cells(), with `is_open` of the mesh as a constant.
template <bool is_open, class Layout>
RRCB_ARITHMETIC_CLONES void find_cells_of(const CellFinder& mesh, const Layout& points,
                                          LocalIndex first, LocalIndex length,
                                          std::int32_t* cells) {
    // These copies need not be reloaded after each of the writes below.
    const CellFinder to = mesh;
    const Layout x = points;
    for (LocalIndex i = 0; i < length; ++i) {
        std::int32_t cell = 0;
        for (int a = Layout::dimension; a-- > 0;) {
            const double offset =
                (x(first + i, a) * to.scale[a] - to.lower[a]) * to.cells_per_length[a];
            // The upper face of the box belongs to the last layer.
            double layer = offset < to.below_num_cells[a] ? offset : to.below_num_cells[a];
            if constexpr (is_open) layer = layer > 0 ? layer : 0;
            cell = cell * to.num_cells[a] + static_cast<std::int32_t>(layer);
        }
        cells[i] = cell;
    }
}

/// Finds the cells of consecutive points. Computing them again is cheaper than storing them.
template <class Layout>
void find_cells(const CellFinder& mesh, const Layout& points, LocalIndex first, LocalIndex length,
                std::int32_t* cells) {
    if (mesh.is_open) {
        find_cells_of<true>(mesh, points, first, length, cells);
    } else {
        find_cells_of<false>(mesh, points, first, length, cells);
    }
}

/// Calls visit(i, cell) for the points from `first` to `last` - 1.
template <class Layout, class Visit>
void visit_cells(const CellFinder& mesh, const Layout& x, LocalIndex first, LocalIndex last,
                 const Visit& visit) {
    constexpr LocalIndex block_length = 256;
    std::array<std::int32_t, block_length> cells;
    in_ranges(last - first, block_length, [&](LocalIndex begin, LocalIndex end) {
        find_cells(mesh, x, first + begin, end - begin, cells.data());
        for (LocalIndex k = begin; k < end; ++k)
            visit(first + k, static_cast<std::size_t>(cells[k - begin]));
    });
}

}  // namespace rrcb
